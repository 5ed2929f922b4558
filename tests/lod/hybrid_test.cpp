// The near surface and the clipmap around it are one closed surface wherever the eye is, and the hole holds
// nothing but the near surface.
#include "lod/hybrid/hybrid.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lod/meters/bare_pixels.h"
#include "lod/meters/openings.h"
#include "lod/meters/surface_raster.h"
#include "tests/lod/hybrid_ground.h"

namespace terrabench::test {
namespace {

std::unique_ptr<Lod> clipmap_over(const Heightfield& field) {
  const LodType& type = lod("clipmap");
  return type.build(field, Parameters(type.parameters), silent());
}

struct Fit {
  const char* name;
  MesoOptions ground;
  HybridOptions options;
  float raised = 0;  // far heights over the near surface's hills, metres
};

Heightfield raised(Heightfield field, float by) {
  for (float& height : field.heights) height += by;
  return field;
}

const std::vector<Fit>& fits() {
  static const std::vector<Fit> kFits = {
      {"as_fine", {}, {.radius = 1}},
      {"finer", {.cell = 0.5F, .cells = 16, .chunks = 12}, {.radius = 2, .band = 4}},
      {"coarser", {.cell = 2, .cells = 8}, {.radius = 1}},
      {"coarser_by_another_factor", {.cell = 1.5F, .cells = 4, .chunks = 16}, {.radius = 2, .band = 3}},
      {"one_chunk", {}, {.radius = 0, .band = 8}},
      {"a_part_of_the_ground", {.low = {20, 33}, .chunks = 3}, {.radius = 1}},
      {"rough", {.relief = 12}, {.radius = 1, .band = 16}},
      {"sharp_rim", {}, {.radius = 1, .band = 1}},
      {"far_heights_above", {}, {.radius = 1}, 2.5F},
      {"far_heights_below", {}, {.radius = 1}, -2.5F},
  };
  return kFits;
}

class HybridFit : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Fit& fit_ = fits()[GetParam()];
  const MesoGround meso_{fit_.ground};
  const Heightfield field_ = raised(meso_.heights(), fit_.raised);
  static HybridOptions from_above(HybridOptions options) {
    options.height = kAboveAll;
    return options;
  }
  Hybrid lod_{{field_, &meso_}, fit_.options};
  Hybrid from_above_{{field_, &meso_}, from_above(fit_.options)};
};

std::string name_of_fit(const ::testing::TestParamInfo<std::size_t>& info) { return fits()[info.param].name; }

TEST_P(HybridFit, IsClosedToTheBitFromEverywhere) {
  std::size_t with_mesh = 0;
  for (const glm::vec2 place : random_places(field_, 15, 5)) {
    const Frame& frame = from_above_.update(everything_from(place.x, place.y));
    ASSERT_EQ(openings_inside(field_, frame), 0U) << place.x << " " << place.y;
    with_mesh += frame.meshes.empty() ? 0 : 1;
  }
  EXPECT_GT(with_mesh, 5U);
}

TEST_P(HybridFit, IsClosedToTheBitInMotion) {
  from_above_.tune(63);
  for (int k = 0; k < 40; ++k) {
    const float along = static_cast<float>(k) / 39;
    const glm::vec2 at = glm::mix(glm::vec2(3, 90), glm::vec2(94, 11), along);
    ASSERT_EQ(openings_inside(field_, from_above_.update(everything_from(at.x, at.y))), 0U) << k;
  }
}

TEST_P(HybridFit, TheHoleHoldsTheNearSurfaceAlone) {
  for (const glm::vec2 place : random_places(field_, 10, 6)) {
    const Frame& frame = from_above_.update(everything_from(place.x, place.y));
    const glm::vec2 low = from_above_.near_outline().low, high = from_above_.near_outline().high;
    Frame far = frame;
    far.meshes = {};
    const std::vector<glm::vec3> beyond = corners_of(far);
    for (std::size_t k = 0; k < beyond.size(); k += 3) {
      const glm::vec3 centre = (beyond[k] + beyond[k + 1] + beyond[k + 2]) / 3.0F;
      const bool in_hole = centre.x > low.x && centre.x < high.x && centre.z > low.y && centre.z < high.y;
      ASSERT_FALSE(in_hole) << centre.x << " " << centre.z;
    }
    Frame near = frame;
    near.batches = {};
    const std::vector<glm::vec3> inside = corners_of(near);
    for (const glm::vec3& p : inside) {
      ASSERT_TRUE(p.x >= low.x && p.x <= high.x && p.z >= low.y && p.z <= high.y);
    }
    // Undersides count negatively, so each place of the hole counts once.
    const glm::vec2 hole = high - low;
    EXPECT_NEAR(plan_area(inside), hole.x * hole.y, 1e-3);
    EXPECT_NEAR(plan_area(frame), plan_area(field_), 1e-2);
  }
}

TEST_P(HybridFit, PassesTheMeters) {
  for (const glm::vec2 place : random_places(field_, 8, 7)) {
    for (const float heading : {0.0F, 2.0F, 4.0F}) {
      const View view = standing(field_, place.x, place.y, heading, 3);
      if (meso_.solid(view.eye) > -0.3F) continue;  // inside the arch
      const Frame& frame = lod_.update(view);
      const OpenEdges edges = find_open_edges(frame, field_, view);
      EXPECT_EQ(edges.edges, 0U);
      EXPECT_EQ(edges.largest_gap_m, 0);
      EXPECT_EQ(edges.largest_gap_px, 0);
      EXPECT_EQ(find_bare_pixels(frame, field_, view).total(), 0U)
          << place.x << " " << place.y << " " << heading;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Hybrid, HybridFit, ::testing::Range(std::size_t{0}, fits().size()), name_of_fit);

TEST(Hybrid, DrawsOverhangsNearTheEyeOnly) {
  const MesoGround meso;
  const Heightfield field = meso.heights();
  Hybrid lod({field, &meso}, {.radius = 1, .height = kAboveAll});
  const auto undersides = [&](float x, float z) {
    const std::vector<glm::vec3> corners = corners_of(lod.update(everything_from(x, z)));
    std::size_t n = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      n += glm::cross(corners[k + 1] - corners[k], corners[k + 2] - corners[k]).y < -1e-3F;
    }
    return n;
  };
  EXPECT_GT(undersides(48, 48), 200U);  // the arch and the tunnel
  EXPECT_EQ(undersides(4, 92), 0U);     // hills alone
}

TEST(Hybrid, TheHoleFollowsTheEyeByChunks) {
  const MesoGround meso;
  const Heightfield field = meso.heights();
  Hybrid lod({field, &meso}, {.radius = 1});
  const auto outline_at = [&](float x, float z) {
    lod.update(standing(field, x, z, 0));
    return lod.near_outline();
  };
  EXPECT_EQ(outline_at(40, 41), (hybrid::Outline{{16, 16}, {64, 64}}));
  EXPECT_EQ(outline_at(47.9F, 32), (hybrid::Outline{{16, 16}, {64, 64}}));
  EXPECT_EQ(outline_at(48.1F, 32), (hybrid::Outline{{32, 16}, {80, 64}}));
  EXPECT_EQ(outline_at(0, 96), (hybrid::Outline{{0, 64}, {32, 96}}));
}

TEST(Hybrid, HighAboveTheGroundTheClipmapIsDrawnAlone) {
  const MesoGround meso;
  const Heightfield field = meso.heights();
  Hybrid lod({field, &meso}, {.radius = 1});
  View view = standing(field, 48, 48, 0);
  EXPECT_FALSE(lod.update(view).meshes.empty());
  view.eye.y += 200;
  view.target.y += 100;
  EXPECT_TRUE(lod.update(view).meshes.empty());
  const auto clipmap = clipmap_over(field);
  EXPECT_EQ(corners_of(lod.update(view)), corners_of(clipmap->update(view)));
}

// Where the near surface is the heights, the rim changes nothing.
TEST(Hybrid, OverHeightsItDrawsTheClipmapsSurface) {
  const Heightfield field = hilly(203, 170, 0.7F);
  Hybrid lod({field}, {});
  const auto clipmap = clipmap_over(field);
  for (const glm::vec2 place : random_places(field, 10, 3)) {
    const View view = standing(field, place.x, place.y, 1);
    const SurfaceRaster drawn(lod.update(view), field.width, field.depth);
    const SurfaceRaster expected(clipmap->update(view), field.width, field.depth);
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        const bool both = drawn.is_drawn(i, j) && expected.is_drawn(i, j);
        ASSERT_TRUE(!both || drawn.at(i, j) == expected.at(i, j)) << i << " " << j;
      }
    }
  }
}

// The planted fault: the cut without interpolation.
TEST(Hybrid, WithoutInterpolationTheMetersFindTheRim) {
  const MesoGround meso;
  const Heightfield field = raised(meso.heights(), 0.5F);
  Hybrid lod({field, &meso}, {.radius = 1, .interpolate = false});
  std::size_t edges = 0, pixels = 0;
  double metres = 0, on_screen = 0;
  for (const glm::vec2 place : random_places(field, 10, 7)) {
    const View view = standing(field, place.x, place.y, 3, 3);
    const Frame& frame = lod.update(view);
    const OpenEdges open = find_open_edges(frame, field, view);
    edges += open.edges;
    metres = std::max(metres, open.largest_gap_m);
    on_screen = std::max(on_screen, open.largest_gap_px);
    pixels += find_bare_pixels(frame, field, view).total();
  }
  EXPECT_GT(edges, 100U);
  EXPECT_GT(metres, 0.1);
  EXPECT_GT(on_screen, 1);
  EXPECT_GT(pixels, 20U);
}

}  // namespace
}  // namespace terrabench::test
