// Patches that morph between levels: their heights, and less popping.
#include "lod/geomipmap/morphing.h"

#include <gtest/gtest.h>

#include "lod/camera/camera_path.h"
#include "lod/geomipmap/geomipmap.h"
#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "tests/lod/drawing.h"

namespace terrabench::test {
namespace {

constexpr int kSide = 8;

PatchMorph all_at(float level) { return {level, {level, level, level, level}}; }

float height_of(const Heightfield& field, const PatchMorph& morph, int level, glm::ivec2 at) {
  return morphed_height(grid_of(field), kSide, morph, level, {0, 0}, at);
}

TEST(MorphedHeight, GoesFromTheSampleToTheCoarserEdge) {
  const Heightfield field = hilly(9, 9, 1);
  const auto mean = [&](glm::ivec2 a, glm::ivec2 b) {
    return 0.5F * (field.at(a.x, a.y) + field.at(b.x, b.y));
  };
  struct Case {
    glm::ivec2 at, a, b;
  };
  // Along x, along z, along both diagonals, and on the sides; a and b are the ends of the coarser edge.
  for (const auto& [at, a, b] : {Case{{3, 2}, {2, 2}, {4, 2}},
                                 {{2, 5}, {2, 4}, {2, 6}},
                                 {{1, 1}, {0, 0}, {2, 2}},
                                 {{3, 1}, {2, 2}, {4, 0}},
                                 {{1, 3}, {0, 4}, {2, 2}},
                                 {{3, 3}, {2, 2}, {4, 4}},
                                 {{5, 0}, {4, 0}, {6, 0}},
                                 {{8, 7}, {8, 6}, {8, 8}}}) {
    EXPECT_EQ(height_of(field, all_at(0), 0, at), field.at(at.x, at.y));
    EXPECT_NEAR(height_of(field, all_at(0.999999F), 0, at), mean(a, b), 1e-4);
    EXPECT_NEAR(height_of(field, all_at(0.25F), 0, at), 0.75F * field.at(at.x, at.y) + 0.25F * mean(a, b),
                1e-5);
  }
  for (const glm::ivec2 stays : {glm::ivec2{2, 2}, {4, 6}, {0, 0}, {8, 0}, {8, 8}, {0, 4}, {6, 8}}) {
    EXPECT_EQ(height_of(field, all_at(0.7F), 0, stays), field.at(stays.x, stays.y));
  }
}

// A vertex next to a side with a coarser level moves towards the side's height.
TEST(MorphedHeight, SidesGoTheirOwnWay) {
  const Heightfield field = hilly(9, 9, 1);
  const PatchMorph ahead{0.5F, {1.25F, 0.5F, 0.5F, 0.5F}};
  const float side = height_of(field, ahead, 0, {2, 0});
  EXPECT_NEAR(side, 0.75F * field.at(2, 0) + 0.125F * (field.at(0, 0) + field.at(4, 0)), 1e-5);
  EXPECT_NEAR(height_of(field, ahead, 0, {2, 1}), 0.5F * field.at(2, 1) + 0.25F * (side + field.at(2, 2)),
              1e-5);
  EXPECT_EQ(height_of(field, ahead, 0, {2, 3}), height_of(field, all_at(0.5F), 0, {2, 3}));
}

struct Flown {
  double popping = 0;       // the largest of any frame, pixels
  double error_p99 = 0;     // pixels
  std::size_t changes = 0;  // of levels
};

// Compares frames along a path with their predecessors, and checks cracks and the bound.
Flown fly(const Heightfield& field, const std::vector<View>& path, std::size_t stride, bool morph,
          double pixels) {
  Progress silent;
  GeoMipMap lod(field, {16, false, morph}, silent);
  lod.tune(pixels);
  Flown flown;
  Distribution errors;
  SurfaceRaster before(field.width, field.depth), after(field.width, field.depth);
  for (std::size_t k = stride; k < path.size(); k += stride) {
    before.draw(lod.update(path[k - 1]));
    const Frame& frame = lod.update(path[k]);
    after.draw(frame);
    flown.changes += frame.stats.changes;
    const SeenSamples seen(field, path[k]);
    flown.popping = std::max(flown.popping, popping(before, after, seen).in_frustum.largest);
    EXPECT_LE(screen_error(after, field, seen, &errors).in_frustum.largest, pixels);
    const CrackReport cracks = find_cracks(frame, field.width, field.depth, path[k]);
    EXPECT_TRUE(cracks.tight());
    EXPECT_EQ(cracks.t_junctions, 0U);
  }
  flown.error_p99 = errors.quantile(0.99);
  return flown;
}

// With everything in view, no cut patches and small steps, levels change without popping.
TEST(Morphing, NothingJumps) {
  const Heightfield field = hilly(129, 129, 0.5F);
  std::vector<View> path(200);
  for (std::size_t k = 0; k < path.size(); ++k) {
    path[k].eye = {50, 300 - 0.8F * static_cast<float>(k), 420 - 0.8F * static_cast<float>(k)};
    path[k].target = {64, 0, 64};
  }
  const Flown with = fly(field, path, 1, true, 3), without = fly(field, path, 1, false, 3);
  EXPECT_GT(with.changes, 50U);
  EXPECT_LT(with.popping, 0.2);
  EXPECT_GT(without.popping, 1);
}

// The knobs give the morph no larger error; patches come into view, and some are cut.
TEST(Morphing, LowersTheLargestPoppingAlongThePathsAtEqualError) {
  // The paths of square ground leave this one at its southern side.
  Heightfield square = hilly(403, 403, 1);
  square.cell_x = square.cell_z = 5;
  const Heightfield field = crop(square, 0, 0, 403, 344);
  for (const char* name : {"cross", "fly"}) {
    SCOPED_TRACE(name);
    const std::vector<View> path = views(camera_path(name), square);
    const Flown without = fly(field, path, 20, false, 2), with = fly(field, path, 20, true, 1.5);
    EXPECT_LE(with.error_p99, without.error_p99);
    EXPECT_LT(with.popping, 0.5 * without.popping);
  }
}

}  // namespace
}  // namespace terrabench::test
