// Thermal erosion of stacks: what it conserves, where it stops and what it leaves alone.
#include "representations/layered_stack/thermal_erosion.h"

#include <tbb/global_control.h>

#include <array>
#include <map>

#include "representations/implicit/implicit_surface.h"
#include "terrain/error.h"
#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

using Stack = std::unique_ptr<LayeredStack>;

Stack stack_of(const TerrainSource& source, std::int64_t resolution, double step = 0) {
  Progress progress;
  return LayeredStack::build_stack(source, with(representation("layered_stack"), resolution, step), progress);
}

ThermalErosion erode(LayeredStack& stack, const ThermalErosionOptions& options) {
  Progress progress;
  return erode_thermally(stack, stack, options, progress);
}

// One byte per cell: too simple to be wrong.
struct Cells {
  int width, depth, levels;
  std::vector<Material> all;
  explicit Cells(const LayeredStack& stack)
      : width(stack.grid().width), depth(stack.grid().depth), levels(stack.grid().levels) {
    all.resize(static_cast<std::size_t>(width) * depth * levels);
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        stack.column(i, j).each_solid([&](int bottom, int top, Material material) {
          for (int y = bottom; y < top; ++y) all[index(i, y, j)] = material;
        });
      }
    }
  }
  std::size_t index(int i, int y, int j) const {
    return (static_cast<std::size_t>(j) * width + i) * levels + y;
  }
  bool solid(int i, int y, int j) const { return y < 0 || all[index(i, y, j)] != Material::kAir; }
  std::map<Material, std::size_t> counts() const {
    std::map<Material, std::size_t> counts;
    for (const Material m : all) ++counts[m];
    return counts;
  }
  int top(int i, int j) const {
    int y = levels;
    while (y > 0 && !solid(i, y - 1, j)) --y;
    return y;
  }
};

// The largest excess of a drop from an open surface into a neighbour's air, in levels above what is allowed.
int steepest_excess(const LayeredStack& stack, double talus) {
  const Cells cells(stack);
  const ColumnGrid& grid = stack.grid();
  int worst = -cells.levels;
  for (int j = 0; j < cells.depth; ++j) {
    for (int i = 0; i < cells.width; ++i) {
      for (int y = 1; y <= cells.levels; ++y) {  // the surface at y
        if (!cells.solid(i, y - 1, j) || (y < cells.levels && cells.solid(i, y, j))) continue;
        for (int dj = -1; dj <= 1; ++dj) {
          for (int di = -1; di <= 1; ++di) {
            const int ni = i + di, nj = j + dj;
            if (ni < 0 || nj < 0 || ni >= cells.width || nj >= cells.depth) continue;
            int ground = y;
            while (ground > 0 && !cells.solid(ni, ground - 1, nj)) --ground;
            const double run = std::hypot(di * grid.cell_x, dj * grid.cell_z);
            const int allowed = std::max(
                1, static_cast<int>(std::tan(talus * std::numbers::pi / 180) * run / grid.step + 1e-6));
            worst = std::max(worst, y - ground - allowed);
          }
        }
      }
    }
  }
  return worst;
}

TerrainSource tower(float half, float height) {  // on a floor of 64 × 64 m, 64 m high, bare
  return from_predicate({{0, 0, 0}, {64, 64, 64}}, [=](float x, float y, float z) {
    const bool inside = std::abs(x - 32.5F) < half && std::abs(z - 32.5F) < half && y < height;
    return inside ? Material{2} : Material::kAir;
  });
}

TEST(ThermalErosion, ConservesEveryMaterialAndEndsAtTheTalusAngle) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const double talus : {0.0, 30.0, 60.0, 80.0}) {
      for (const double share : {1.0, 0.3}) {
        const Stack stack = stack_of(random_boxes(seed, 24, 40, 3), 24);
        const auto before = Cells(*stack).counts();
        const bool steep = steepest_excess(*stack, talus) > 0;
        const ThermalErosion result = erode(*stack, {.talus = talus, .share = share});
        EXPECT_TRUE(result.settled);
        EXPECT_EQ(Cells(*stack).counts(), before);
        EXPECT_LE(steepest_excess(*stack, talus), 0) << seed << " " << talus << " " << share;
        EXPECT_EQ(result.moved > 0, steep);
        EXPECT_TRUE(steep);
      }
    }
  }
}

TEST(ThermalErosion, SingleCellsFullOfGapsConserveTheirVolume) {
  const Stack stack = stack_of(random_cells(5, 20, 30, 17, 3, 45), 30);
  const auto before = Cells(*stack).counts();
  EXPECT_TRUE(erode(*stack, {.talus = 40}).settled);
  EXPECT_EQ(Cells(*stack).counts(), before);
  EXPECT_LE(steepest_excess(*stack, 40), 0);
}

// A cone of radius r and slope k has the volume π k r³ / 3. Eight directions make it an octagon's pyramid,
// whose sides lie between the circle and the circle around it, 1/cos(22.5°) as far away. Levels are fine and
// shares small, so that no move goes far beyond the talus angle and leaves a flatter pile.
TEST(ThermalErosion, APileOfSandBecomesTheConeOfItsVolume) {
  const Stack stack = stack_of(tower(5, 60), 64, 1.0 / 16);
  const double volume = 10.0 * 10 * 60;
  const Cells start(*stack);
  const double cells = static_cast<double>(start.all.size() - start.counts()[Material::kAir]) / 16;
  EXPECT_NEAR(cells, volume, 0.25 * volume);
  ASSERT_TRUE(erode(*stack, {.talus = 45, .share = 0.2}).settled);
  const Cells after(*stack);
  const double radius = std::cbrt(3 * cells / std::numbers::pi);
  EXPECT_NEAR(after.top(32, 32) / 16.0, radius, 0.12 * radius);
  for (int angle = 0; angle < 360; angle += 15) {
    double reached = 0;
    for (double r = 0; r < 31; r += 0.25) {
      const double a = angle * std::numbers::pi / 180;
      if (after.top(static_cast<int>(32.5 + r * std::cos(a)), static_cast<int>(32.5 + r * std::sin(a))) > 0)
        reached = r;
    }
    EXPECT_NEAR(reached, radius, 0.15 * radius) << angle;
  }
}

TEST(ThermalErosion, NothingMovesBelowTheTalusAngle) {
  const auto ramp = [](float slope) {
    return from_predicate({{0, 0, 0}, {40, 40, 10}}, [=](float x, float y, float) {
      return y < 0.01F + slope * x ? Material::kBedrock : Material::kAir;
    });
  };
  const Stack stack = stack_of(ramp(0.9F), 40);
  const Stack untouched = stack_of(ramp(0.9F), 40);
  const ThermalErosion rest = erode(*stack, {.talus = 45});
  EXPECT_TRUE(rest.settled);
  EXPECT_EQ(rest.steps, 0);
  EXPECT_EQ(rest.columns, 0U);
  EXPECT_TRUE(*stack == *untouched);
  const Stack steep = stack_of(ramp(2.5F), 40);
  EXPECT_GT(erode(*steep, {.talus = 45}).moved, 0);
}

// A roof at rest over a cave whose floor has a step: the sand in the cave slides, the roof and its air stay.
TEST(ThermalErosion, SlidesInACaveUnderARoofAtRest) {
  const TerrainSource cave = from_predicate({{0, 0, 0}, {20, 30, 20}}, [](float x, float y, float) {
    if (y >= 20) return y < 25 ? Material{3} : Material::kAir;
    return y < (x < 10 ? 12.0F : 2.0F) ? Material::kBedrock : Material::kAir;
  });
  const Stack stack = stack_of(cave, 30);
  EXPECT_GT(erode(*stack, {.talus = 45}).moved, 0);
  const Cells after(*stack);
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 20; ++i) {
      int ground = 0;
      while (after.solid(i, ground, j)) ++ground;
      EXPECT_LE(ground, 12);
      EXPECT_GE(ground, 2);
      for (int y = ground; y < 30; ++y) ASSERT_EQ(after.solid(i, y, j), y >= 20 && y < 25);
    }
  }
  EXPECT_LE(steepest_excess(*stack, 45), 0);
}

TEST(ThermalErosion, RockBesideTheSurfaceHoldsIt) {  // the neighbour's air begins under the top cell
  const TerrainSource wall = from_predicate({{0, 0, 0}, {2, 20, 1}}, [](float x, float y, float) {
    if (x < 1) return y < 10 ? Material::kBedrock : Material::kAir;
    return y >= 9 && y < 11 ? Material::kBedrock : Material::kAir;
  });
  const Stack stack = stack_of(wall, 20);
  EXPECT_EQ(erode(*stack, {.talus = 10}).moved, 0);
}

TEST(ThermalErosion, ALedgeThatSlidesAwayJoinsTheAirAboveAndBelow) {
  const TerrainSource ledge = from_predicate({{0, 0, 0}, {2, 20, 1}}, [](float x, float y, float) {
    if (x < 1 && y >= 10 && y < 13) return y < 12 ? Material{4} : Material{5};
    return y < 1 ? Material::kBedrock : Material::kAir;
  });
  const Stack stack = stack_of(ledge, 20);
  const auto before = Cells(*stack).counts();
  ASSERT_TRUE(erode(*stack, {.talus = 45}).settled);
  EXPECT_EQ(Cells(*stack).counts(), before);
  EXPECT_EQ(Cells(*stack).top(0, 0) + Cells(*stack).top(1, 0), 5);
  // The topmost slides first and comes to lie lowest.
  EXPECT_EQ(Cells(*stack).all[Cells(*stack).index(1, 1, 0)], Material{5});
}

TEST(ThermalErosion, DoesNotDependOnTheNumberOfThreads) {
  std::array<Stack, 3> stacks;
  for (std::size_t n = 0; n < stacks.size(); ++n) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::array{1, 2, 7}[n]);
    stacks[n] = stack_of(random_boxes(9, 40, 60, 3), 40);
    erode(*stacks[n], {.talus = 35, .share = 0.5, .steps = 12});
  }
  EXPECT_TRUE(*stacks[0] == *stacks[1]);
  EXPECT_TRUE(*stacks[0] == *stacks[2]);
  EXPECT_FALSE(*stacks[0] == *stack_of(random_boxes(9, 40, 60, 3), 40));
}

TEST(ThermalErosion, SmallestFlatAndEmptyTerrainsStay) {
  const auto of = [](glm::vec3 size, float height) {
    return from_predicate({{0, 0, 0}, size}, [=](float, float y, float) {
      return y < height ? Material::kBedrock : Material::kAir;
    });
  };
  for (const TerrainSource& source : {of({1, 8, 1}, 8), of({9, 4, 1}, 2), of({1, 4, 9}, 2), of({9, 9, 9}, 0),
                                      of({9, 9, 9}, 5), of({9, 9, 9}, 9)}) {
    const Stack stack = stack_of(source, 9), untouched = stack_of(source, 9);
    const ThermalErosion result = erode(*stack, {.talus = 0});
    EXPECT_TRUE(result.settled);
    EXPECT_EQ(result.moved, 0);
    EXPECT_TRUE(*stack == *untouched);
  }
}

TEST(ThermalErosion, StopsAtTheLimitAndRefusesWrongOptions) {
  const Stack stack = stack_of(tower(3, 60), 64), untouched = stack_of(tower(3, 60), 64);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ThermalErosionOptions& wrong : {ThermalErosionOptions{.talus = -1},
                                             {.talus = 90},
                                             {.talus = nan},
                                             {.share = 0},
                                             {.share = 1.1},
                                             {.share = nan},
                                             {.steps = -1}}) {
    EXPECT_THROW(erode(*stack, wrong), Error);
  }
  EXPECT_FALSE(erode(*stack, {.steps = 0}).settled);
  EXPECT_TRUE(*stack == *untouched);
  const ThermalErosion result = erode(*stack, {.steps = 2});
  EXPECT_EQ(result.steps, 2);
  EXPECT_FALSE(result.settled);
}

TEST(ThermalErosion, ThroughTheImplicitSurfaceChunksChangeTheirVersions) {
  ImplicitSurface surface(stack_of(tower(3, 40), 64), Kernel::kCube, 0, 0, Extractor{});
  const Stack plain = stack_of(tower(3, 40), 64);
  Progress progress;
  erode_thermally(surface.stack(), surface, {.talus = 45}, progress);
  erode(*plain, {.talus = 45});
  EXPECT_TRUE(surface.stack() == *plain);
  EXPECT_GT(surface.version({0, 0}) + surface.version({1, 1}), 0U);
}

}  // namespace
}  // namespace terrabench::test
