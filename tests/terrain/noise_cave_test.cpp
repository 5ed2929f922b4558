// The hybrid paper's cave terrain: what it claims of each stage.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/noise/cave_terrain.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::noise {
namespace {

struct Grid {
  int n;
  std::vector<Material> cells;  // columns of n, x fastest among columns
  bool solid(int x, int y, int z) const {
    return cells[(static_cast<std::size_t>(z) * n + x) * n + y] != Material::kAir;
  }
};

Grid sample(const Solid& solid, int n) {
  Grid grid{n, std::vector<Material>(static_cast<std::size_t>(n) * n * n)};
  const float d = solid.bounds.high.x / static_cast<float>(n);
  for (int z = 0; z < n; ++z) {
    for (int x = 0; x < n; ++x) {
      solid.column({(static_cast<float>(x) + 0.5F) * d, (static_cast<float>(z) + 0.5F) * d, 0.5F * d, d},
                   std::span(grid.cells).subspan((static_cast<std::size_t>(z) * n + x) * n, n));
    }
  }
  return grid;
}

struct Shape {
  int boundaries = 0, overhangs = 0;  // changes of material along columns; columns with more than one
  double share = 0;                   // solid
};

Shape shape(const Grid& g) {
  Shape s;
  for (int z = 0; z < g.n; ++z) {
    for (int x = 0; x < g.n; ++x) {
      int changes = 0;
      for (int y = 0; y < g.n; ++y) {
        s.share += g.solid(x, y, z);
        changes += y > 0 && g.solid(x, y, z) != g.solid(x, y - 1, z);
      }
      s.boundaries += changes;
      s.overhangs += changes > 1;
    }
  }
  s.share /= std::pow(g.n, 3);
  return s;
}

// Sizes of the connected components (6 neighbours) of cells of one kind, those that touch the bottom left
// out.
std::vector<int> components(const Grid& g, bool solid) {
  std::vector<char> seen(g.cells.size());
  std::vector<std::array<int, 3>> stack;
  const auto visit = [&](int x, int y, int z) {
    if (x < 0 || y < 0 || z < 0 || x >= g.n || y >= g.n || z >= g.n || g.solid(x, y, z) != solid) return;
    char& mark = seen[(static_cast<std::size_t>(z) * g.n + x) * g.n + y];
    if (mark == 0) stack.push_back({x, y, z});
    mark = 1;
  };
  const auto flood = [&] {
    int size = 0;
    for (; !stack.empty(); ++size) {
      const auto [x, y, z] = stack.back();
      stack.pop_back();
      visit(x + 1, y, z), visit(x - 1, y, z), visit(x, y + 1, z);
      visit(x, y - 1, z), visit(x, y, z + 1), visit(x, y, z - 1);
    }
    return size;
  };
  std::vector<int> sizes;
  for (int y = 0; y < g.n; ++y) {
    for (int z = 0; z < g.n; ++z) {
      for (int x = 0; x < g.n; ++x) {
        visit(x, y, z);
        const int size = flood();
        if (size > 0 && y > 0) sizes.push_back(size);
      }
    }
  }
  return sizes;
}

TEST(CaveTerrain, HillsAloneAreAHeightmapAndXMakesOverhangs) {
  CaveOptions options{.perturb_x = false, .caves = false};
  const Shape hills = shape(sample(cave_terrain(options), 96));
  EXPECT_EQ(hills.boundaries, 96 * 96);
  EXPECT_EQ(hills.overhangs, 0);
  options.perturb_x = true;
  EXPECT_GT(shape(sample(cave_terrain(options), 96)).overhangs, 96 * 96 / 200);
}

TEST(CaveTerrain, AttenuationKeepsFloatingIslandsOut) {
  std::size_t with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    with += components(sample(cave_terrain({.seed = seed}), 96), true).size();
    without += components(sample(cave_terrain({.seed = seed, .attenuation = false}), 96), true).size();
  }
  EXPECT_LT(3 * with, without);
}

// Tunnels: a small part of the ground, in pieces large enough to walk through rather than in pores, and every
// solid cell of the carved terrain is one of the uncarved.
TEST(CaveTerrain, CavesAreTunnelsInTheGround) {
  const Grid whole = sample(cave_terrain({.caves = false}), 96), carved = sample(cave_terrain({}), 96);
  double removed = 0, ground = 0;
  Grid caves{96, std::vector<Material>(carved.cells.size(), Material::kAir)};
  for (std::size_t i = 0; i < whole.cells.size(); ++i) {
    ASSERT_LE(carved.cells[i], whole.cells[i]);
    ground += whole.cells[i] != Material::kAir;
    if (carved.cells[i] == whole.cells[i]) continue;
    caves.cells[i] = Material::kBedrock;
    ++removed;
  }
  EXPECT_GT(removed / ground, 0.02);
  EXPECT_LT(removed / ground, 0.2);
  int largest = 0;
  double in_pores = 0;  // pieces that touch the bottom are not listed, and go on below it
  for (const int size : components(caves, true)) {
    largest = std::max(largest, size);
    in_pores += size < 64 ? size : 0;
  }
  EXPECT_LT(in_pores / removed, 0.1);
  EXPECT_GT(largest, 200);
}

TEST(CaveTerrain, ThePrintedProductOpensWhereEitherMapDoes) {
  const Grid both = sample(cave_terrain({}), 64),
             either = sample(cave_terrain({.printed_product = true}), 64);
  for (std::size_t i = 0; i < both.cells.size(); ++i) ASSERT_LE(either.cells[i], both.cells[i]);
  EXPECT_LT(shape(either).share, shape(both).share - 0.05);
}

// Each cave map distorted by a fractal of its own: other caves, of about the same size.
TEST(CaveTerrain, ASixthFractalMakesSimilarCaves) {
  const Grid five = sample(cave_terrain({}), 48), six = sample(cave_terrain({.share_roughness = false}), 48);
  const Grid none = sample(cave_terrain({.caves = false}), 48);
  EXPECT_NE(five.cells, six.cells);
  const double carved = shape(none).share - shape(five).share;
  EXPECT_NEAR(shape(none).share - shape(six).share, carved, 0.5 * carved);
}

TEST(CaveTerrain, ColumnsHaveFewBoundaries) {
  // 3 bytes per run and 2 per column must stay below the paper's 24 bytes per column.
  for (const int n : {64, 128}) {
    const double average = shape(sample(cave_terrain({}), n)).boundaries / static_cast<double>(n * n);
    EXPECT_LT(2 + 3 * (average + 1), 16) << n;
    EXPECT_GT(average, 1.5) << n;
  }
}

TEST(CaveTerrain, IsTheSameTerrainAtAnySamplingAndScale) {
  const Solid small = cave_terrain({.extent = 128}), large = cave_terrain({.extent = 1024});
  const Grid coarse = sample(small, 32), coarse_large = sample(large, 32);
  EXPECT_EQ(coarse.cells, coarse_large.cells);
  EXPECT_NE(small.checksum, large.checksum);
  EXPECT_EQ(large.bounds.high, glm::vec3(1024));
  // Every third sample of a finer grid has the same place as one of the coarser.
  const Grid fine = sample(small, 96);
  int different = 0;
  for (int z = 0; z < 32; ++z) {
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x)
        different += fine.solid(3 * x + 1, 3 * y + 1, 3 * z + 1) != coarse.solid(x, y, z);
    }
  }
  EXPECT_LT(different, 8);  // places that differ by rounding
}

TEST(CaveTerrain, IsTheSameWhenEveryCellIsEvaluated) {
  const Solid skipping = cave_terrain(), every = cave_terrain({.every_cell = true});
  EXPECT_EQ(every.checksum, skipping.checksum);
  for (const std::size_t n : {1U, 37U, 300U}) {
    std::vector<Material> a(n), b(n);
    for (int i = 0; i < 200; ++i) {
      const ColumnSamples at{0.61F * static_cast<float>(i), 127.0F - 0.63F * static_cast<float>(i), 0.2F,
                             127.0F / static_cast<float>(n)};
      skipping.column(at, a);
      every.column(at, b);
      ASSERT_EQ(a, b) << n << " samples, column " << i;
    }
  }
}

TEST(CaveTerrain, IsTheSameOnAllInstructionSets) {
  const Grid expected = sample(cave_terrain({.seed = 3}), 48);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    EXPECT_EQ(sample(cave_terrain({.seed = 3}), 48).cells, expected.cells) << simd_name();
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(CaveTerrain, ChecksumNamesWhatShapesIt) {
  const CaveOptions variants[] = {{},
                                  {.seed = 2},
                                  {.extent = 64},
                                  {.perturb_x = false},
                                  {.caves = false},
                                  {.attenuation = false},
                                  {.printed_product = true}};
  std::set<std::string> checksums;
  for (const CaveOptions& options : variants) checksums.insert(cave_terrain(options).checksum);
  EXPECT_EQ(checksums.size(), std::size(variants));
  EXPECT_EQ(cave_terrain({}).checksum, cave_terrain({}).checksum);
}

TEST(CaveTerrain, RefusesExtentsThatAreNone) {
  for (const float extent :
       {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_THROW(cave_terrain({.extent = extent}), Error);
  }
}

// Each figure is an image of its own within the range it says. Figure 12 is the product of figures 8 and 11,
// and figure 13 removes less of the terrain.
TEST(CaveTerrain, StagesAreThePapersFigures) {
  std::vector<std::vector<float>> images;
  for (int s = 0; s < kStages; ++s) {
    const StageInfo& stage = info(static_cast<Stage>(s));
    EXPECT_EQ(stage.stage, static_cast<Stage>(s));
    EXPECT_EQ(stage.figure, s + 3);
    const CaveGraph graph = graph_for(stage.stage, {});
    std::vector<float> image(64 * 64);
    Program(graph.graph, graph.root)
        .slice({.x0 = 1, .y0 = 1, .dx = 2, .dy = 2, .z = 40, .width = 64, .height = 64}, image);
    for (const float v : image) {
      if (stage.stage == Stage::kFbm || stage.stage == Stage::kFlatFbm) {
        EXPECT_LE(std::abs(v), 1.0F);
      } else {
        EXPECT_GE(v, stage.low) << stage.name;
        EXPECT_LE(v, stage.high) << stage.name;
      }
    }
    for (const auto& other : images) EXPECT_NE(image, other) << stage.name;
    images.push_back(image);
  }
  const auto& terrain = images[8 - 3];
  const auto& caves = images[11 - 3];
  for (std::size_t i = 0; i < terrain.size(); ++i) {
    EXPECT_EQ(images[12 - 3][i], terrain[i] * caves[i]);
    EXPECT_LE(images[12 - 3][i], images[13 - 3][i]);
    EXPECT_LE(images[13 - 3][i], terrain[i]);
  }
}

}  // namespace
}  // namespace terrabench::noise
