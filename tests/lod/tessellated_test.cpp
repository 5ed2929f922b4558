// The triangles of a patch against the rules of OpenGL, the factors against every sample, and what the knob
// bounds.
#include "lod/tessellated/tessellated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "terrain/error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/patch_frame.h"
#include "tests/lod/promises.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

using tessellated::factor_log, tessellated::kInside;

Tessellated make(const Heightfield& field, const Tessellated::Options& options, double pixels) {
  Tessellated lod(field, options, silent());
  lod.tune(pixels);
  return lod;
}

// Samples of a patch with its low corner at sample 0, without heights.
std::vector<std::array<glm::ivec2, 3>> triangles_of(const Frame& frame) {
  const std::vector<glm::vec3> corners = corners_of(frame);
  std::vector<std::array<glm::ivec2, 3>> all(corners.size() / 3);
  for (std::size_t k = 0; k < corners.size(); ++k) all[k / 3][k % 3] = {corners[k].x, corners[k].z};
  return all;
}

// Every combination for a small patch: the vertices are those of the specification, and the triangles cover
// the patch once.
TEST(PatchTriangles, DividePatchesAsOpenGlDoes) {
  constexpr int kSide = 8;
  const Heightfield field = random_ground(kSide + 1, kSide + 1, 1, 0, 9);
  for (int all = 0; all < 4 * 4 * 4 * 4 * 3; ++all) {
    const std::array<int, 4> sides{all & 3, all >> 2 & 3, all >> 4 & 3, all >> 6 & 3};
    const int inside = 1 + (all >> 8), n = 1 << inside, step = kSide / n;
    const PatchFrame patch(field, kSide, [&](int, int) { return packed(sides, inside); });
    const Frame frame = patch.frame();
    std::set<std::pair<int, int>> used, expected;
    for (const auto& triangle : triangles_of(frame)) {
      for (const glm::ivec2 at : triangle) used.emplace(at.x, at.y);
    }
    for (int k = 0; k <= kSide; ++k) {
      const auto on = [&](Side side) { return k % (kSide >> sides[side]) == 0; };
      if (on(kNorth)) expected.emplace(k, 0);
      if (on(kSouth)) expected.emplace(k, kSide);
      if (on(kWest)) expected.emplace(0, k);
      if (on(kEast)) expected.emplace(kSide, k);
    }
    for (int j = 1; j < n; ++j) {
      for (int i = 1; i < n; ++i) expected.emplace(i * step, j * step);
    }
    ASSERT_EQ(used, expected) << all;
    ASSERT_DOUBLE_EQ(plan_area(frame), kSide * kSide);
    const CrackReport cracks = find_cracks(frame, field.width, field.depth, from_above(field));
    ASSERT_TRUE(cracks.tight()) << all;
    ASSERT_EQ(cracks.t_junctions, 0U);
    std::size_t segments = 0;
    for (const int side : sides) segments += (std::size_t{1} << side) + static_cast<std::size_t>(n - 2);
    ASSERT_EQ(frame.stats.triangles, segments + 2U * (n - 2) * (n - 2));
  }
}

// Patches that the border cuts, with equal factors at shared sides.
TEST(PatchTriangles, CoverGroundOfAnySize) {
  std::mt19937 random(5);
  for (const auto& [width, depth] : {std::pair{2, 2}, {2, 40}, {17, 5}, {18, 18}, {34, 29}, {45, 33}}) {
    const Heightfield field = random_ground(width, depth, 2, 0, 9);
    for (int round = 0; round < 20; ++round) {
      std::map<std::array<int, 3>, int> sides;
      const auto side = [&](int x, int z, int across) {
        return sides.try_emplace({x, z, across}, static_cast<int>(random() % 5)).first->second;
      };
      const PatchFrame patches(field, 16, [&](int x, int z) {
        return packed({side(x, z, 1), side(x + 1, z, 0), side(x, z + 1, 1), side(x, z, 0)},
                      1 + static_cast<int>(random() % 4));
      });
      const CrackReport cracks = find_cracks(patches.frame(), width, depth, from_above(field));
      ASSERT_TRUE(cracks.tight()) << width << " × " << depth << ": " << cracks.gaps << " gaps, "
                                  << cracks.bare_edges << " bare, " << cracks.overlaps << " overlaps";
      ASSERT_DOUBLE_EQ(plan_area(patches.frame()), plan_area(field));
    }
  }
}

TEST(Tessellated, KeepsItsPromisesFromAnywhere) {
  std::mt19937 random(11);
  double closest = 0;
  for (const auto& [width, depth] : {std::pair{2, 2}, {3, 70}, {65, 65}, {66, 34}, {131, 100}}) {
    const Heightfield field = hilly(width, depth, 0.7F, 2, 5, 3);
    for (const int side : {4, 16, 64}) {
      for (const double pixels : {0.7, 5.0}) {
        Tessellated lod = make(field, {side}, pixels);
        for (int k = 0; k < 12; ++k) {
          const View view = random_view(field, random);
          closest = std::max(closest, expect_promises(lod.update(view), field, view, pixels) / pixels);
        }
      }
    }
  }
  EXPECT_GT(closest, 0.9);
}

// The factors by number of the patch's low corner.
std::map<std::uint32_t, std::uint32_t> factors_of(const Frame& frame) {
  std::map<std::uint32_t, std::uint32_t> factors;
  for (const TessellatedPatch& patch : frame.patches) factors[patch.corner] = patch.factors;
  return factors;
}

TEST(Tessellated, PatchesShareTheFactorsOfTheirSides) {
  const Heightfield field = hilly(200, 150, 0.5F, 1, 5, 5);
  for (const bool by_error : {true, false}) {
    Tessellated lod = make(field, {16, by_error}, by_error ? 2 : 20);
    std::size_t unlike = 0;
    for (const View& view : path_over(field, 30)) {
      const auto factors = factors_of(lod.update(view));
      for (const auto& [corner, own] : factors) {
        const auto east = factors.find(corner + 16), south = factors.find(corner + 16 * 200);
        if (east != factors.end() && (corner + 16) % 200 != 0) {
          ASSERT_EQ(factor_log(own, kEast), factor_log(east->second, kWest));
        }
        if (south != factors.end()) {
          ASSERT_EQ(factor_log(own, kSouth), factor_log(south->second, kNorth));
        }
        unlike += factor_log(own, kEast) != factor_log(own, kWest) ? 1 : 0;
      }
    }
    EXPECT_GT(unlike, 50U);
  }
}

// Across a ridge a side needs so many segments that a vertex lies on the crest; along it, so many that no
// strip reaches it. So does the one side whose strip would reach a peak.
TEST(Tessellated, ChoosesSidesByTheirOwnErrorsAndThoseBeside) {
  Heightfield field = flat(33, 33);
  const View view = from_above(field);
  View close = view;
  close.eye.y = 60;
  for (const auto& [x, expected] : {std::pair{16, 1}, {24, 2}, {28, 3}, {30, 4}, {31, 5}}) {
    Heightfield one = field;
    for (int k = 0; k < 33 * 33; ++k) {
      const int at = k % 33;
      one.at(at, k / 33) = 10 * (at <= x ? static_cast<float>(at) / static_cast<float>(x)
                                         : static_cast<float>(32 - at) / static_cast<float>(32 - x));
    }
    Tessellated lod = make(one, {32}, 0.05);
    const std::uint32_t factors = lod.update(close).patches[0].factors;
    EXPECT_EQ(factor_log(factors, kNorth), expected) << x;
    EXPECT_EQ(factor_log(factors, kSouth), expected);
    EXPECT_EQ(factor_log(factors, kEast), x == 16 ? 0 : expected);
    EXPECT_EQ(factor_log(factors, kWest), 0);
  }
  field.at(7, 9) = 10;
  Tessellated lod = make(field, {32}, 0.05);
  EXPECT_EQ(lod.update(close).patches[0].factors, packed({0, 0, 0, 3}, 5));
}

TEST(Tessellated, DrawsFlatLandWithFourTrianglesAPatch) {
  const Heightfield field = flat(257, 257, 700);
  Tessellated lod = make(field, {32}, 0.05);
  const Frame& frame = lod.update(from_above(field));
  EXPECT_EQ(frame.patches.size(), 64U);
  EXPECT_EQ(frame.stats.triangles, 4U * 64);
}

// From above all sides have the same length: halving the knob doubles all factors, on any ground.
TEST(Tessellated, ByLengthHalvesSegmentsWithTheKnob) {
  const Heightfield field = flat(129, 129);
  View view = from_above(field);
  view.vertical_fov = 0.15F;
  view.width = view.height = 600;
  const auto factors = [&](double pixels) {
    return make(field, {32, false}, pixels).update(view).patches[0].factors;
  };
  // The ground is 600 pixels wide or somewhat less, and so a side at most 150.
  const double length = 32 * 300 / std::tan(0.075) / view.eye.y;
  for (int log = 1; log <= 5; ++log) {
    const double knob = 1.1 * length / (1 << log);
    EXPECT_EQ(factors(knob), packed({log, log, log, log}, log)) << knob;
    EXPECT_EQ(factor_log(factors(0.9 * length / (1 << log)), kNorth), std::min(log + 1, 5));
  }
}

TEST(Tessellated, ByLengthKeepsNoBoundAndHasNoCracks) {
  const Heightfield field = random_ground(131, 100, 3, 0, 30);
  Tessellated lod = make(field, {16, false}, 10);
  const View view = path_over(field, 50)[1];
  const Frame& frame = lod.update(view);
  EXPECT_TRUE(find_cracks(frame, field.width, field.depth, view).tight());
  EXPECT_GT(screen_error(SurfaceRaster(frame, field.width, field.depth), field, SeenSamples(field, view))
                .in_frustum.largest,
            10);
}

TEST(Tessellated, SendsHeightsOnceAndThenPatchesAlone) {
  const Heightfield field = hilly(300, 200, 0.1F);
  Tessellated lod = make(field, {16}, 3);
  const std::vector<View> all = views(camera_path("fly"), field);
  EXPECT_EQ(lod.update(all[0]).stats.bytes_uploaded, 4 * field.heights.size());
  EXPECT_EQ(lod.update(all[0]).stats.changes, 0U);
  const Frame& later = lod.update(all[100]);
  EXPECT_GT(later.stats.changes, 0U);
  EXPECT_EQ(later.stats.bytes_sent(), 8 * later.patches.size());
}

TEST(Tessellated, TakesNoHeapBytesAFrame) {
  const Heightfield field = hilly(300, 257, 1);
  Tessellated lod = make(field, {16}, 1);
  const std::vector<View> all = views(camera_path("fly"), field);
  for (const View& view : all) lod.update(view);
  for (const View& view : all) lod.update(view);  // arrays of two frames take turns
  const std::int64_t live = HeapCounter::live();
  HeapCounter::reset_peak();
  for (const View& view : all) lod.update(view);
  EXPECT_EQ(HeapCounter::peak(), live);
}

TEST(Tessellated, RefusesPatchesOfOtherSizes) {
  const Heightfield field = flat(9, 9);
  const LodType& type = lod("tessellated");
  Parameters parameters(type.parameters);
  for (const std::int64_t wrong : {1, 2, 5, 48, 128}) {
    EXPECT_THROW(
        {
          parameters.set("patch", wrong);
          (void)type.build(field, parameters, silent());
        },
        Error)
        << wrong;
  }
}

}  // namespace
}  // namespace terrabench::test
