// Spheres and an event against the shape's own equation, column by column.
#include "representations/edit_tools.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "representations/implicit/implicit_surface.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

TerrainSource block(float size) {  // of bedrock, one column per metre, from -10 m on
  return from_predicate({glm::vec3(-10), glm::vec3(size - 10)},
                        [](float, float, float) { return Material::kBedrock; });
}

class Tools : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Types, Tools,
                         testing::ValuesIn(types([](const Traits& t) { return t.editable && t.materials; })),
                         [](const auto& at) { return std::string(at.param); });

TEST_P(Tools, DiggingASphereLeavesItsComplement) {
  const auto built = build(GetParam(), block(40), 40);
  const Sphere sphere{{4.3F, 8.1F, 6.7F}, 9.4F};
  const std::size_t columns = fill_sphere(*built, sphere, Material::kAir);
  const Lattice lattice(built->bounds(), 40, 40);
  const SpanSink sink = spans_of(*built, lattice.columns());
  std::size_t within = 0;
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    const double squared = 9.4 * 9.4 - std::pow(lattice.x[c] - 4.3, 2) - std::pow(lattice.z[c] - 6.7, 2);
    if (squared <= 0) {
      ASSERT_EQ(sink.column(c).size(), 1U);
      EXPECT_EQ(sink.column(c)[0], (Span{-10, 30, Material::kBedrock}));
      continue;
    }
    ++within;
    if (squared < 0.5) continue;  // may lie between two levels' centres
    ASSERT_EQ(sink.column(c).size(), 2U);
    EXPECT_NEAR(sink.column(c)[0].top, 8.1 - std::sqrt(squared), 0.501);
    EXPECT_NEAR(sink.column(c)[1].bottom, 8.1 + std::sqrt(squared), 0.501);
  }
  EXPECT_EQ(columns, within);
  EXPECT_GT(within, 200U);
}

TEST_P(Tools, FillingRestoresWhatWasDug) {
  const auto built = build(GetParam(), block(24), 24), untouched = build(GetParam(), block(24), 24);
  const Lattice lattice(built->bounds(), 24, 24);
  const Sphere sphere{{0, 2, -9}, 7};  // cut by the border
  fill_sphere(*built, sphere, Material::kAir);
  EXPECT_FALSE(same_spans(spans_of(*built, lattice.columns()), spans_of(*untouched, lattice.columns())));
  fill_sphere(*built, sphere, Material::kBedrock);
  EXPECT_TRUE(same_spans(spans_of(*built, lattice.columns()), spans_of(*untouched, lattice.columns())));
}

TEST_P(Tools, ErodingRemovesAllAboveTheLowerHalf) {
  const auto built = build(GetParam(), block(40), 40);
  const events::RadialErosion event{{4.3, 8.1, 6.7}, {9.4, 5.2, 6.3}};
  const std::size_t columns = erode(*built, event);
  const Lattice lattice(built->bounds(), 40, 40);
  const SpanSink sink = spans_of(*built, lattice.columns());
  std::size_t within = 0;
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    const double bottom = event.bottom({lattice.x[c], lattice.z[c]});
    ASSERT_EQ(sink.column(c).size(), 1U);
    if (bottom == HUGE_VAL) {
      EXPECT_EQ(sink.column(c)[0], (Span{-10, 30, Material::kBedrock}));
      continue;
    }
    ++within;
    EXPECT_NEAR(sink.column(c)[0].top, bottom, 0.501);
  }
  EXPECT_EQ(columns, within);
  EXPECT_GT(within, 150U);
  const std::vector<std::byte> before = saved(*built);
  const float infinity = std::numeric_limits<float>::infinity();
  for (const events::RadialErosion& wrong :
       {events::RadialErosion{{0, 0, 0}, {1, 0, 1}}, events::RadialErosion{{0, 0, 0}, {1, 1, infinity}},
        events::RadialErosion{{infinity, 0, 0}, {1, 1, 1}}, events::RadialErosion{{90, 0, 0}, {1, 1, 1}},
        events::RadialErosion{{0, 90, 0}, {1, 1, 1}}}) {
    EXPECT_THROW(erode(*built, wrong), Error);
  }
  EXPECT_EQ(erode(*built, {{-13, 8, 6}, {2, 5, 9}}), 0U);  // beside the terrain, which its circle reaches
  EXPECT_EQ(saved(*built), before);
}

TEST_P(Tools, ErodingTakesHeightsThatFloatsDoNotHold) {
  for (const events::RadialErosion& event : {events::RadialErosion{{0, -1e300, 0}, {8, 1, 8}},
                                             events::RadialErosion{{0, 1e300, 0}, {8, 2e300, 8}}}) {
    const auto built = build(GetParam(), block(40), 40);
    const std::size_t columns = erode(*built, event);
    const Lattice lattice(built->bounds(), 40, 40);
    const SpanSink sink = spans_of(*built, lattice.columns());
    std::size_t within = 0;
    for (std::size_t c = 0; c < sink.columns(); ++c) {
      const double bottom = event.bottom({lattice.x[c], lattice.z[c]});
      within += bottom < HUGE_VAL ? 1 : 0;
      EXPECT_EQ(sink.column(c).size(), bottom < 0 ? 0U : 1U) << lattice.x[c] << ' ' << lattice.z[c];
    }
    EXPECT_EQ(columns, within);
    EXPECT_GT(within, 150U);
  }
}

TEST_P(Tools, WrongShapesChangeNothing) {
  const auto built = build(GetParam(), block(20), 20);
  const std::vector<std::byte> before = saved(*built);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  for (const Sphere& wrong :
       {Sphere{{0, 0, 0}, 0},
        {{0, 0, 0}, -1},
        {{0, 0, 0}, nan},
        {{0, 0, 0}, infinity},
        {{nan, 0, 0}, 1},
        {{0, infinity, 0}, 1},
        {{-15, 0, 0}, 4.9F},
        {{0, 0, 50}, 5},
        {{0, 100, 0}, 5},
        {{1e30F, 0, 0}, 5},
        {{-13, 0, -13}, 4}}) {  // the last: nearer than its radius to both sides, not to the corner
    EXPECT_THROW(fill_sphere(*built, wrong, Material::kAir), Error);
  }
  EXPECT_EQ(fill_sphere(*built, {{0, 0, 0}, 0.2F}, Material::kAir), 0U);  // between the axes
  EXPECT_EQ(saved(*built), before);
  EXPECT_NO_THROW(fill_sphere(*built, {{0, 0, 0}, 1e30F}, Material::kAir));
  EXPECT_TRUE(spans_of(*built, Lattice(built->bounds(), 20, 20).columns()).all().empty());
}

TEST(EditTools, TypesThatCannotBeEditedRefuse) {
  for (const RepresentationType& type : representations()) {
    const auto built = build(type.name, from_heights(4, 4, std::vector<float>(16, 5)));
    if (type.traits.editable) {
      EXPECT_GT(fill_sphere(*built, {{1, 5, 1}, 1}, Material::kAir), 0U) << type.name;
    } else {
      EXPECT_THROW(fill_sphere(*built, {{1, 5, 1}, 1}, Material::kAir), Error) << type.name;
      EXPECT_THROW(erode(*built, {{1, 5, 1}, {1, 1, 1}}), Error) << type.name;
    }
  }
}

TEST(EditTools, OnlyChunksNearTheSphereGetANewVersion) {
  const auto built = build("implicit", block(160), 160);
  auto& surface = dynamic_cast<ImplicitSurface&>(*built);
  const Sphere sphere{{40, 100, 40}, 10};  // 50 m from the corner of the chunks, which are 32 m wide
  fill_sphere(surface, sphere, Material::kAir);
  const glm::ivec2 chunks = surface.chunks();
  ASSERT_EQ(chunks, glm::ivec2(5));
  for (int j = 0; j < chunks.y; ++j) {
    for (int i = 0; i < chunks.x; ++i) {
      const auto distance = [](int chunk) {
        return std::max(
            {0.0F, 32.0F * static_cast<float>(chunk) - 50, 50 - 32.0F * static_cast<float>(chunk + 1)});
      };
      const float away = std::hypot(distance(i), distance(j));
      const std::uint64_t version = surface.version({i, j});
      if (away < sphere.radius) {
        EXPECT_GT(version, 0U) << i << " " << j;
      } else if (std::max(distance(i), distance(j)) > sphere.radius + 8) {
        EXPECT_EQ(version, 0U) << i << " " << j;
      }
    }
  }
  const std::vector<float> x{40, 90}, z{40, 90};
  const SpanSink sink = spans_of(surface, {x, z});
  EXPECT_EQ(sink.column(0).size(), 2U);
  EXPECT_EQ(sink.column(1).size(), 1U);
}

}  // namespace
}  // namespace terrabench::test
