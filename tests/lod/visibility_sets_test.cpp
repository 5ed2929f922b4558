// Visible sets against rays cast at the full surface, and what Mrbsp draws with them.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "lod/lod.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/mrbsp.h"
#include "lod/mrbsp/visibility/line_of_sight.h"
#include "tests/lod/visible_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::mrbsp::visibility {
namespace {

struct Facet {
  glm::vec3 a, b, c;
  NodeNumber node;
};

// All triangles of the greatest depth, clamped to the field, without those that have no plan area.
std::vector<Facet> facets(const Heightfield& field, const BisectionTree& tree) {
  std::vector<Facet> facets;
  const auto place = [&](glm::ivec2 at) {
    const int i = std::min(at.x, field.width - 1), j = std::min(at.y, field.depth - 1);
    return glm::vec3(static_cast<float>(i) * field.cell_x, field.at(i, j),
                     static_cast<float>(j) * field.cell_z);
  };
  for (NodeNumber node = tree.triangles(); node < 2 * tree.triangles(); ++node) {
    const PlanTriangle t = tree.triangle(node);
    const Facet facet{place(t.apex), place(t.left), place(t.right), node};
    const glm::vec3 normal = glm::cross(facet.b - facet.a, facet.c - facet.a);
    if (normal.y > 0) facets.push_back(facet);
  }
  return facets;
}

// The ray-triangle test of Möller and Trumbore (1997), in double; the ends of the segment do not count.
bool blocks(const Facet& f, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 along = to - from, u = glm::dvec3(f.b) - glm::dvec3(f.a),
                   v = glm::dvec3(f.c) - glm::dvec3(f.a);
  const glm::dvec3 p = glm::cross(along, v);
  const double det = glm::dot(u, p);
  if (std::abs(det) < 1e-12) return false;
  const glm::dvec3 s = from - glm::dvec3(f.a);
  const double a = glm::dot(s, p) / det;
  const glm::dvec3 q = glm::cross(s, u);
  const double b = glm::dot(along, q) / det, t = glm::dot(v, q) / det;
  return a >= 0 && b >= 0 && a + b <= 1 && t > 1e-9 && t < 1 - 1e-6;
}

bool is_free(const std::vector<Facet>& facets, const glm::dvec3& eye, const glm::dvec3& target) {
  for (const Facet& f : facets) {
    if (blocks(f, eye, target)) return false;
  }
  return true;
}

struct Tally {
  std::size_t seen = 0, missed = 0;
};

// Rays from random eyes in random cells to the middle and near the corners of random facets.
Tally cast_rays(const Heightfield& field, const BisectionTree& tree, const Sets& sets, int eyes,
                int targets) {
  const auto ground = facets(field, tree);
  Tally tally;
  std::uint32_t key = 1;
  const auto random = [&] { return random_share(key++ * 2654435761U); };
  for (int e = 0; e < eyes; ++e) {
    const float x = random() * field.extent_x(), z = random() * field.extent_z();
    // Every fourth eye is lower than the eye height: the sets must cover these too.
    const glm::dvec3 eye(x, field.sample(x, z) + sets.eye_height * (e % 4 == 0 ? 0.5 : 1.0), z);
    const int column = std::min(static_cast<int>(x / field.cell_x) / sets.cells.side, sets.cells.columns - 1);
    const int row = std::min(static_cast<int>(z / field.cell_z) / sets.cells.side, sets.cells.rows - 1);
    for (int t = 0; t < targets; ++t) {
      const Facet& f = ground[std::min(
          ground.size() - 1, static_cast<std::size_t>(random() * static_cast<float>(ground.size())))];
      const float s = random(), u = random() * (1 - s);
      const glm::dvec3 target(f.a * (1 - s - u) + f.b * s + f.c * u);
      // Only targets seen from above: an eye of half the height may be below the triangles, though above the
      // samples.
      const glm::dvec3 normal =
          glm::cross(glm::dvec3(f.b) - glm::dvec3(f.a), glm::dvec3(f.c) - glm::dvec3(f.a));
      if (glm::dot(normal, eye - target) <= 0 || !is_free(ground, eye, target)) continue;
      ++tally.seen;
      const auto element =
          static_cast<std::uint32_t>((f.node >> (tree.depth() - sets.depth)) - (NodeNumber{1} << sets.depth));
      tally.missed += !sets.sees(row * sets.cells.columns + column, element);
    }
  }
  return tally;
}

double share_visible(const Sets& sets) {
  double sum = 0;
  for (int cell = 0; cell < sets.cells.count(); ++cell) sum += static_cast<double>(sets.count(cell));
  return sum / sets.cells.count() / std::pow(2.0, sets.depth);
}

TEST(VisibleSets, ConservativeMissesNothingAndHidesSomething) {
  // A side of 2^k + 1 samples, other sizes, and one whose finest triangles extend beyond the field.
  for (const auto& [width, depth, levels] :
       {std::tuple{33, 33, 11}, {41, 29, 13}, {33, 27, 10}, {38, 33, 11}}) {
    const Heightfield field = rough_ground(width, depth);
    const BisectionTree tree = BisectionTree::over(width, depth, levels);
    for (const int coarseness : {0, 2, 4, 6}) {
      const Sets sets = visible_over(field, tree, few_cells(8, coarseness));
      EXPECT_EQ(sets.depth % 2, 1);
      const Tally tally = cast_rays(field, tree, sets, 60, 60);
      EXPECT_GT(tally.seen, 100U);
      EXPECT_EQ(tally.missed, 0U);
      EXPECT_LT(share_visible(sets), coarseness < 4 ? 0.8 : 1.0)
          << width << " x " << depth << ", " << coarseness;
    }
  }
}

constexpr Mode kModes[] = {Mode::kSampled, Mode::kConservative, Mode::kVertices, Mode::kFacing,
                           Mode::kInterior};

TEST(VisibleSets, SampledMissesLittleAndHidesMore) {
  const Heightfield field = rough_ground(33, 33);
  const BisectionTree tree(5, 11);
  const Sets safe = visible_over(field, tree, few_cells(8, 2));
  for (const auto& [mode, most] : {std::pair{Mode::kVertices, 0.005},
                                   {Mode::kSampled, 0.01},
                                   {Mode::kFacing, 0.04},
                                   {Mode::kInterior, 0.04}}) {
    const Sets sampled = visible_over(field, tree, few_cells(8, 2, mode));
    EXPECT_LT(share_visible(sampled), share_visible(safe)) << name_of(mode);
    const Tally tally = cast_rays(field, tree, sampled, 60, 60);
    EXPECT_LT(static_cast<double>(tally.missed), most * static_cast<double>(tally.seen))
        << name_of(mode) << ": " << tally.missed << " of " << tally.seen;
  }
}

bool is_subset(const Sets& part, const Sets& whole) {
  for (std::size_t w = 0; w < part.bits.size(); ++w) {
    if ((part.bits[w] & ~whole.bits[w]) != 0) return false;
  }
  return true;
}

TEST(VisibleSets, ReadingsOfTheSamplingNest) {
  const Heightfield field = rough_ground(41, 33);
  const BisectionTree tree = BisectionTree::over(41, 33);
  const auto sets = [&](Mode mode) { return visible_over(field, tree, few_cells(8, 6, mode)); };
  const Sets facing = sets(Mode::kFacing), sampled = sets(Mode::kSampled), all = sets(Mode::kVertices);
  EXPECT_TRUE(is_subset(facing, sampled));
  EXPECT_TRUE(is_subset(sampled, all));
  EXPECT_LT(share_visible(facing), share_visible(sampled));
  EXPECT_LT(share_visible(sampled), share_visible(all));
}

// Sampled sets from their definition: rays at all facets of the coarse surface.
TEST(VisibleSets, SampledHoldsWhatTheCornersSee) {
  const Heightfield field = rough_ground(33, 30);
  const BisectionTree tree = BisectionTree::over(33, 30), coarse(5, 7);
  const GroundGrid grid = grid_of(field);
  const CoarseSquares squares(tree, 7);
  const LineOfSight surface(grid, squares);  // for the height of the coarse surface alone
  const auto ground = facets(field, coarse);
  for (const Mode mode : {Mode::kSampled, Mode::kFacing}) {
    const Sets sets = visible_over(field, tree, few_cells(4, 4, mode));
    ASSERT_EQ(sets.depth, 7);
    std::size_t visible = 0;
    for (int cell = 0; cell < sets.cells.count(); ++cell) {
      const int side = sets.cells.side;
      const glm::ivec2 low(cell % sets.cells.columns * side, cell / sets.cells.columns * side);
      const glm::ivec2 high = glm::min(low + side, glm::ivec2(field.width - 1, field.depth - 1));
      std::vector<glm::dvec3> eyes;
      for (const int x : {low.x, high.x}) {
        for (const int z : {low.y, high.y}) {
          constexpr float kIn = LineOfSight::kInset;
          const float u = x == low.x ? x + kIn : x - kIn, v = z == low.y ? z + kIn : z - kIn;
          const float y = std::max(sample_height(grid, u, v), surface.height(u, v)) + sets.eye_height;
          eyes.emplace_back(u * field.cell_x, y, v * field.cell_z);
        }
      }
      for (const Facet& f : ground) {
        const glm::dvec3 a(f.a), b(f.b), c(f.c), normal = glm::cross(b - a, c - a);
        const glm::dvec3 middle = (a + b + c) / 3.0;
        const glm::dvec2 at(middle.x / field.cell_x, middle.z / field.cell_z);
        bool seen = at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y;  // under the cell
        for (const glm::dvec3& eye : eyes) {
          if (mode == Mode::kFacing && glm::dot(normal, eye - a) <= 0) continue;
          seen = seen || is_free(ground, eye, a) || is_free(ground, eye, b) || is_free(ground, eye, c);
        }
        visible += seen;
        EXPECT_EQ(sets.sees(cell, static_cast<std::uint32_t>(f.node - (NodeNumber{1} << 7))), seen)
            << name_of(mode) << ", cell " << cell << ", triangle " << f.node;
      }
    }
    EXPECT_GT(visible, ground.size() * sets.cells.count() / 10);
    EXPECT_LT(visible, ground.size() * sets.cells.count() * 9 / 10);
  }
}

TEST(VisibleSets, OnFlatLandEverythingIsSeen) {
  const Heightfield field = rough_ground(33, 33, 0);
  for (const Mode mode : kModes) {
    EXPECT_EQ(share_visible(visible_over(field, BisectionTree(5, 11), few_cells(4, 6, mode))), 1.0);
  }
}

TEST(VisibleSets, AWallHidesWhatStandsBehindIt) {
  Heightfield field = rough_ground(33, 33, 0);
  for (int j = 0; j < 33; ++j) field.at(16, j) = 500;
  const BisectionTree tree(5, 11);
  for (const Mode mode : kModes) {
    const Sets sets = visible_over(field, tree, few_cells(4, 4, mode));
    const bool faces = mode == Mode::kFacing || mode == Mode::kInterior;
    for (int row = 0; row < 4; ++row) {
      for (std::uint32_t e = 0; e < 1U << sets.depth; ++e) {
        const PlanTriangle t = tree.triangle((NodeNumber{1} << sets.depth) + e);
        const auto [low, high] = std::minmax({t.apex.x, t.left.x, t.right.x});
        // A triangle that touches the wall is as high as the wall. Conservative sets may contain those behind
        // it, and an eye that need not be faced sees their vertices on the wall.
        if (high <= 16) {
          EXPECT_TRUE(sets.sees(row * 4, e));
        } else if (low > 16 || faces) {
          EXPECT_FALSE(sets.sees(row * 4, e));
        }
        if (low >= 16) {
          EXPECT_TRUE(sets.sees(row * 4 + 3, e));
        } else if (high < 16 || faces) {
          EXPECT_FALSE(sets.sees(row * 4 + 3, e));
        }
      }
    }
  }
}

TEST(VisibleSets, IsTheSameForAnyNumberOfThreads) {
  const Heightfield field = rough_ground(65, 50);
  const BisectionTree tree = BisectionTree::over(65, 50);
  for (const Mode mode : kModes) {
    const Options options = few_cells(16, 6, mode);
    const Sets many = visible_over(field, tree, options);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(visible_over(field, tree, options), many);
  }
}

// Lines of sight over the coarse surface against rays cast at its facets.
TEST(LineOfSight, IsBlockedByTheSurfaceAlone) {
  const Heightfield field = rough_ground(30, 33);
  const BisectionTree tree(5, 11);
  const GroundGrid grid = grid_of(field);
  const CoarseSquares squares(tree, 11);
  const LineOfSight lines(grid, squares);
  const auto ground = facets(field, tree);
  const glm::vec3 cell(field.cell_x, 1, field.cell_z);
  int clear = 0, differ = 0;
  constexpr int kRays = 1500;
  for (std::uint32_t k = 0; k < kRays; ++k) {
    const auto place = [&](std::uint32_t salt) {
      const float x = 29 * random_share(7 * k + salt), z = 32 * random_share(7 * k + salt + 1);
      return glm::vec3(x, lines.height(x, z) + 12 * random_share(7 * k + salt + 2), z);
    };
    const glm::vec3 from = place(0), to = place(3);
    const bool expected = is_free(ground, glm::dvec3(from * cell), glm::dvec3(to * cell));
    clear += expected;
    differ += lines.clear(from, to) != expected;
  }
  EXPECT_GT(clear, kRays / 10);
  EXPECT_LT(clear, 9 * kRays / 10);
  EXPECT_EQ(differ, 0);
}

TEST(VisibleSets, RefusesOptionsOutOfRange) {
  const Heightfield field = rough_ground(33, 33);
  const BisectionTree tree(5, 11);
  const auto refused = [&](auto change) {
    Options options;
    change(options);
    EXPECT_EQ(failure_of([&] { (void)visible_over(field, tree, options); }).code, ExitCode::kUsage);
  };
  refused([](Options& o) { o.cells = 0; });
  refused([](Options& o) { o.coarseness = -1; });
  refused([](Options& o) { o.coarseness = 1000; });
  refused([](Options& o) { o.eye_height = -1; });
  refused([](Options& o) { o.eye_height = std::numeric_limits<float>::quiet_NaN(); });
}

// An eye below a valley sees the undersides of the hills, so the sets for observers above must not be used.
TEST(Mrbsp, VisibilityLeavesOutTrianglesOnlyOnTheGround) {
  const Heightfield field = rough_ground(65, 65);
  MrbspOptions options;
  options.area_consistent = true;
  Mrbsp plain(field, options, silent());
  options.visibility = true;
  options.visible = few_cells(8, 2);
  Mrbsp hiding(field, options, silent());
  for (Mrbsp* lod : {&plain, &hiding}) lod->tune(Mrbsp::knob().finest);
  for (const float above : {0.0F, 10.0F, -12.0F, -5.0F, -20.0F}) {
    View view = walker(field, 0.45F, 0.55F, 1);
    view.eye.y += above;
    view.target.y += above;
    EXPECT_EQ(hiding.on_the_ground(view.eye), above == 0) << above;
    const std::size_t all = plain.update(view).stats.triangles, some = hiding.update(view).stats.triangles;
    EXPECT_GT(some, 0U);
    EXPECT_EQ(some < all, above == 0) << above;
    EXPECT_LE(some, all);
  }
}

// What is refused of a table from a file is in visibility_codec_test.cpp.
TEST(Mrbsp, TakesATableThatFitsAndRefusesOthers) {
  Heightfield field = rough_ground(65, 50);
  const ChangeTable table = table_over(65, 50);
  EXPECT_EQ(Mrbsp(field, {}, table, silent()).visibility(), table);
  field.cell_z *= 2;
  EXPECT_EQ(failure_of([&] { Mrbsp(field, {}, table, silent()); }).code, ExitCode::kUsage);
}

}  // namespace
}  // namespace terrabench::mrbsp::visibility
