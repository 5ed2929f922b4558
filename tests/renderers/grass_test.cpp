// Grass as the GPU draws it: numbers, places and pictures.
#include "renderers/grass/grass.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "renderers/context.h"
#include "renderers/gl.h"
#include "renderers/grass/grass_scene.h"
#include "renderers/target.h"
#include "terrain/error.h"
#include "terrain/metrics/image_error.h"
#include "terrain/view.h"
#include "tests/renderers/meadow.h"

namespace terrabench {
namespace {

class Grass : public ::testing::Test {
 protected:
  Grass() { look_.world_to_clip = world_to_clip(view_), look_.eye = view_.eye; }

  Image picture(GrassPatch& patch, GrassTechnique technique, bool ground = true) {
    begin();
    if (ground) ground_.draw(look_);
    grass_.draw(patch, look_, technique);
    check_gl("grass");
    return context_->target().read();
  }
  void begin() {
    context_->target().bind();
    glEnable(GL_DEPTH_TEST);
    glClearColor(0.7F, 0.8F, 0.9F, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  std::int64_t count(GrassPatch& patch, GrassTechnique technique) {
    begin();
    return grass_.count_billboards(patch, look_, technique);
  }

  std::unique_ptr<GlContext> context_ = open_context("osmesa", 320, 240);
  TriangleMesh mesh_ = meadow(24);
  PlainGround ground_{grass_ground(mesh_)};
  GrassRenderer grass_;
  View view_ = overview(bounds_of(mesh_), 320, 240, {0.4F, 0.5F, 1.0F});
  GrassLook look_{};
};

// For each strand: the triangle that grows it, and its number.
template <class Use>
void each_strand(const GrassPlan& plan, const Use& use) {
  for (std::size_t t = 0; t < plan.growing(); ++t) {
    for (std::uint32_t k = plan.triangles[t].w; k < plan.triangles[t + 1].w; ++k) use(plan.triangles[t], k);
  }
}

// How far a point lies from a triangle's plane, and whether it lies above the triangle, up to rounding.
struct Place {
  double off = 0;
  bool inside = false;
};
Place place(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const auto weight = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) / square;
  };
  return {std::abs(glm::dot(p - a, normal)) / std::sqrt(square),
          std::min({weight(a, b), weight(b, c), weight(c, a)}) > -1e-4};
}

TEST_F(Grass, TheGpuDrawsTheNumbersOfTable3) {
  glEnable(GL_RASTERIZER_DISCARD);  // only counts
  for (const std::int64_t billboards : {83'920L, 167'840L, 251'760L}) {
    GrassPatch patch(grass_ground(mesh_), {.strands = billboards / 2});
    for (const GrassTechnique technique : kGrassTechniques) {
      EXPECT_EQ(count(patch, technique), billboards) << static_cast<int>(technique);
    }
  }
}

TEST_F(Grass, ThreeTechniquesDrawTheSameBlades) {
  for (const bool turned : {false, true}) {
    GrassPatch patch(grass_ground(mesh_), {.strands = 6000, .turned = turned, .height = 0.8F, .width = 0.8F});
    look_.wind = {0.3F, 0.1F};
    look_.seconds = 4;
    look_.fog_density = 0.001F;
    const Image printed = picture(patch, GrassTechnique::kGeometryShader);
    EXPECT_LT(ssim(printed, picture(patch, GrassTechnique::kGeometryShader, false)), 0.95);
    for (const GrassTechnique technique : {GrassTechnique::kInstancing, GrassTechnique::kIndirect}) {
      EXPECT_GE(ssim(printed, picture(patch, technique)), 0.999) << static_cast<int>(technique);
    }
    // Not because nothing shows: one strand less per triangle is seen.
    GrassPatch fewer(grass_ground(mesh_), {.strands = 4800, .turned = turned, .height = 0.8F, .width = 0.8F});
    EXPECT_LT(ssim(printed, picture(fewer, GrassTechnique::kGeometryShader)), 0.97);
  }
}

TEST_F(Grass, StandsOnItsTriangleWithTheSumOnly) {
  for (const PointReading point : {PointReading::kSum, PointReading::kProduct, PointReading::kCrossProduct}) {
    const GrassGrowth growth{.strands = 9000, .point = point};
    GrassPatch patch(grass_ground(mesh_), growth);
    const std::vector<GrassStrand> strands = grass_.strands(patch);
    const GrassPlan plan = plan_grass(grass_ground(mesh_), growth);
    ASSERT_EQ(strands.size(), 9000U);
    std::size_t on_triangle = 0;
    each_strand(plan, [&](const glm::uvec4& at, std::uint32_t k) {
      const Place found = place(glm::dvec3(strands[k].root), mesh_.positions[at.x], mesh_.positions[at.y],
                                mesh_.positions[at.z]);
      on_triangle += found.off < 1e-4 && found.inside ? 1 : 0;
    });
    if (point == PointReading::kSum) {
      EXPECT_EQ(on_triangle, 9000U);
    } else {
      EXPECT_LT(on_triangle, 90U);
    }
  }
}

// With the hash, a GPU's strands are the processor's up to the rounding of sums. The printed sine of large
// numbers is not: where strands stand depends on who computes it.
TEST_F(Grass, StandsAtTheSamePlaceForEveryProcessorWithTheHashOnly) {
  for (const RandomReading random : {RandomReading::kHash, RandomReading::kPrinted}) {
    const GrassGrowth growth{.strands = 20'000, .random = random, .turned = true};
    GrassPatch patch(grass_ground(mesh_), growth);
    const std::vector<GrassStrand> strands = grass_.strands(patch);
    const GrassPlan plan = plan_grass(grass_ground(mesh_), growth);
    std::size_t same = 0;
    each_strand(plan, [&](const glm::uvec4& at, std::uint32_t k) {
      const GrassStrand here = grow_strand(grass_ground(mesh_), growth, at, k - at.w + 1);
      const GrassStrand& there = strands[k];
      same += glm::distance(here.root, there.root) < 1e-5F && here.random == there.random &&
              std::abs(here.height - there.height) < 1e-6F && glm::distance(here.side, there.side) < 1e-3F;
    });
    if (random == RandomReading::kHash) {
      EXPECT_EQ(same, 20'000U);
    } else {
      EXPECT_LT(same, 19'000U);
    }
  }
}

// No two strands of one triangle or of neighbours stand alike, and none prefers a part of its triangle.
TEST_F(Grass, HashesAreSpreadEvenly) {
  const GrassGrowth growth{.strands = 60'000, .steepest = 180};
  GrassPatch patch(grass_ground(mesh_), growth);
  std::array<int, 16> bins{};
  std::set<float> randoms;
  for (const GrassStrand& strand : grass_.strands(patch)) {
    ++bins[static_cast<std::size_t>(strand.random * 16)];
    randoms.insert(strand.random);
  }
  // Chi-squared with 15 degrees of freedom: 37.7 is exceeded once in a thousand.
  double chi = 0;
  for (const int bin : bins) chi += (bin - 3750.0) * (bin - 3750.0) / 3750.0;
  EXPECT_LT(chi, 37.7);
  EXPECT_GT(randoms.size(), 59'000U);
}

TEST_F(Grass, StrandsFollowTheirGuides) {
  TriangleMesh level = testing::ground(1, 1, [](float, float) { return 0.0F; });
  for (glm::vec3& p : level.positions) p += glm::vec3(3.7F, 0, 5.1F);
  GrassPatch patch(grass_ground(level), {.strands = 2000, .height = 0.5F, .height_variation = 0.2F});
  glm::dvec3 mean(0);
  std::set<std::pair<float, float>> places;
  for (const GrassStrand& strand : grass_.strands(patch)) {
    ASSERT_NEAR(strand.up.y, 1, 1e-6);
    ASSERT_GE(strand.height, 0.399F);
    ASSERT_LE(strand.height, 0.601F);
    ASSERT_NEAR(strand.width / strand.height, 0.4F / 0.5F, 1e-5);
    // The first edge goes south, the second along the diagonal: the side is horizontal and of unit length.
    ASSERT_NEAR(glm::length(strand.side), 1, 1e-5);
    ASSERT_NEAR(strand.side.y, 0, 1e-6);
    mean += glm::dvec3(strand.root);
    places.emplace(strand.root.x, strand.root.z);
  }
  // Uniform over the two triangles of the square.
  EXPECT_NEAR(mean.x / 2000, 4.2, 0.03);
  EXPECT_NEAR(mean.z / 2000, 5.6, 0.03);
  EXPECT_GT(places.size(), 1900U);
}

TEST_F(Grass, IndirectLeavesOutWhatIsNotInView) {
  GrassPatch patch(grass_ground(mesh_), {.strands = 20'000});
  const std::int64_t all = count(patch, GrassTechnique::kIndirect);
  EXPECT_EQ(all, 40'000);
  View close = view_;
  close.near = 0.1F;
  close.eye = {12, 8, 12};
  close.target = {20, 4, 6};
  look_.world_to_clip = world_to_clip(close);
  look_.eye = close.eye;
  const std::int64_t some = count(patch, GrassTechnique::kIndirect);
  EXPECT_LT(some, all / 2);
  EXPECT_GT(some, 1000);
  EXPECT_EQ(count(patch, GrassTechnique::kInstancing), all);
  EXPECT_GE(ssim(picture(patch, GrassTechnique::kInstancing), picture(patch, GrassTechnique::kIndirect)),
            0.999);
  close.target = {12, 80, 12.001F};
  look_.world_to_clip = world_to_clip(close);
  EXPECT_EQ(count(patch, GrassTechnique::kIndirect), 0);
}

TEST_F(Grass, ThinsOutWithDistance) {
  GrassPatch patch(grass_ground(mesh_), {.strands = 5000});
  look_.eye = {12, 4, 12};
  look_.thin_from = 4;
  look_.none_beyond = 10;
  const std::int64_t drawn = count(patch, GrassTechnique::kGeometryShader);
  EXPECT_EQ(count(patch, GrassTechnique::kIndirect), drawn);
  std::int64_t near = 0, reach = 0;
  for (const GrassStrand& strand : grass_.strands(patch)) {
    near += glm::distance(strand.root, look_.eye) < 4 ? 1 : 0;
    reach += glm::distance(strand.root, look_.eye) < 10 ? 1 : 0;
  }
  EXPECT_GT(drawn, 2 * near);
  EXPECT_LT(drawn, 2 * reach);
  const Image geometry = picture(patch, GrassTechnique::kGeometryShader);
  EXPECT_GE(ssim(geometry, picture(patch, GrassTechnique::kInstancing)), 0.999);
  look_.thin_from = look_.none_beyond = 0.01F;
  EXPECT_EQ(count(patch, GrassTechnique::kGeometryShader), 0);
}

TEST_F(Grass, MovesInTheWindOnly) {
  GrassPatch patch(grass_ground(mesh_), {.strands = 5000, .height = 1});
  const Image still = picture(patch, GrassTechnique::kInstancing);
  look_.seconds = 1;
  EXPECT_EQ(still.rgb, picture(patch, GrassTechnique::kInstancing).rgb);
  look_.wind = {0.5F, 0};
  const Image blown = picture(patch, GrassTechnique::kInstancing);
  EXPECT_LT(ssim(still, blown), 0.99);
  look_.seconds = 2;
  EXPECT_LT(ssim(blown, picture(patch, GrassTechnique::kInstancing)), 0.9999);
}

TEST_F(Grass, IsAPassOfAnyRenderer) {
  GrassPatch patch(grass_ground(mesh_), {.strands = 5000});
  begin();
  glEnable(GL_CULL_FACE);
  grass_.draw(patch, look_, GrassTechnique::kInstancing);
  EXPECT_TRUE(glIsEnabled(GL_CULL_FACE));
  EXPECT_FALSE(glIsEnabled(GL_SAMPLE_ALPHA_TO_COVERAGE));
  EXPECT_TRUE(glIsEnabled(GL_DEPTH_TEST));
  glDisable(GL_CULL_FACE);
  // The clip plane of a water pass: what lies below y = 3 is left out.
  const Image whole = picture(patch, GrassTechnique::kInstancing, false);
  look_.clip_plane = {0, 1, 0, -3};
  for (const GrassTechnique technique : kGrassTechniques) {
    glEnable(GL_CLIP_DISTANCE0);
    const Image clipped = picture(patch, technique, false);
    glDisable(GL_CLIP_DISTANCE0);
    const auto ink = [](const Image& image) {
      std::size_t pixels = 0;
      for (std::size_t i = 0; i < image.rgb.size(); i += 3) pixels += image.rgb[i] < 170 ? 1 : 0;
      return pixels;
    };
    EXPECT_LT(ink(clipped), 3 * ink(whole) / 4);
    EXPECT_GT(ink(clipped), ink(whole) / 8);
  }
}

TEST_F(Grass, OnBareGroundDrawsNothing) {
  GrassPatch none(grass_ground(mesh_), {.strands = 1000, .steepest = -1});
  GrassPatch empty({}, {.strands = 1000});
  for (GrassPatch* const patch : {&none, &empty}) {
    EXPECT_EQ(patch->strands(), 0);
    EXPECT_TRUE(grass_.strands(*patch).empty());
    for (const GrassTechnique technique : kGrassTechniques) EXPECT_EQ(count(*patch, technique), 0);
  }
}

TEST_F(Grass, CountsItsBytes) {
  GrassPatch patch(grass_ground(mesh_), {.strands = 1000});
  const std::size_t ground =
      25 * 25 * 24 + (plan_grass(grass_ground(mesh_), {.strands = 1000}).growing() + 1) * 16 + 48 + 16;
  EXPECT_EQ(patch.bytes(), ground);
  count(patch, GrassTechnique::kGeometryShader);
  EXPECT_EQ(patch.bytes(), ground);
  count(patch, GrassTechnique::kIndirect);
  EXPECT_EQ(patch.bytes(), ground + 1000 * 48 + 20);
  count(patch, GrassTechnique::kInstancing);
  EXPECT_EQ(patch.bytes(), ground + 2000 * 48 + 20);
}

}  // namespace
}  // namespace terrabench
