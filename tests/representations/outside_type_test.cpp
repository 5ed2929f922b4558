// A method from outside gets rays, edits, events, lines and faces from the interface alone.
#include <gtest/gtest.h>

#include "representations/column_grid.h"
#include "representations/edit_tools.h"
#include "representations/line_grid.h"
#include "representations/procedural_mesh/face_mesh.h"
#include "representations/ray_cast.h"
#include "representations/representation.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

// 8 × 8 columns of 1 m, each solid up to a height of its own.
class Pillars final : public Representation {
 public:
  Pillars() : tops_(64, 4.0F) {
    grid_.width = grid_.depth = 8;
    grid_.levels = 16;
  }
  void spans(Columns where, SpanSink& out) const override {
    for (std::size_t i = 0; i < where.size(); ++i) {
      if (tops_[column(where.x[i], where.z[i])] > 0)
        out.add({0, tops_[column(where.x[i], where.z[i])], Material::kBedrock});
      out.end_column();
    }
  }
  void edit(Columns where, std::span<const Span> what) override {
    for (std::size_t i = 0; i < where.size(); ++i) {
      float& top = tops_[column(where.x[i], where.z[i])];
      top = what[i].material == Material::kAir ? std::min(top, std::max(0.0F, what[i].bottom))
                                               : std::max(top, what[i].top);
    }
  }
  TriangleMesh mesh(MeshDetail) const override {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {8, 0, 0}, {0, 0, 8}};
    mesh.indices = {0, 2, 1};
    return mesh;
  }
  Memory memory() const override { return {}; }
  void save(ByteSink&) const override {}
  Bounds bounds() const override { return grid_.bounds(); }
  const ColumnGrid* column_grid() const override { return &grid_; }

 private:
  static std::size_t column(float x, float z) {
    const auto index = [](float at) { return static_cast<std::size_t>(std::clamp(at, 0.0F, 7.0F)); };
    return index(z) * 8 + index(x);
  }
  ColumnGrid grid_;
  std::vector<float> tops_;
};

float hit_from_above(const Representation& on, float x, float z) {
  const Ray ray{.origin = {x, 10, z}, .direction = {0, -1, 0}};
  float distance = 0;
  on.ray_caster()->closest({&ray, 1}, {&distance, 1});
  return distance;
}

TEST(OutsideType, TakesRaysEditsAndAnErosionByItsColumns) {
  Pillars pillars;
  EXPECT_FLOAT_EQ(hit_from_above(pillars, 3.5F, 3.5F), 6);
  EXPECT_GT(fill_sphere(pillars, {{3.5F, 4, 3.5F}, 2}, Material::kAir), 4U);
  EXPECT_FLOAT_EQ(hit_from_above(pillars, 3.5F, 3.5F), 8);
  EXPECT_FLOAT_EQ(hit_from_above(pillars, 7.5F, 7.5F), 6);
  pillars.apply(events::RadialErosion{{6.5, 4, 6.5}, {1, 3, 1}});
  EXPECT_FLOAT_EQ(hit_from_above(pillars, 6.5F, 6.5F), 9);
  EXPECT_THROW(pillars.apply(events::Carving{}), Error) << "a cave needs a type with the trait events";
}

TEST(OutsideType, HasLinesAndFacesOfItsOwn) {
  const Pillars pillars;
  const LineGrid lines = pillars.lines();
  EXPECT_EQ(lines.width, 8);
  EXPECT_EQ(lines.origin_x, 0.5);
  EXPECT_EQ(pillars.polygons().faces(), 1U);
  EXPECT_TRUE(pillars.facts().empty());
}

}  // namespace
}  // namespace terrabench
