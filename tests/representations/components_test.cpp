#include "representations/layered_stack/components.h"

#include <map>

#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

// By flooding a byte grid, cell by cell.
Components flood(const LayeredStack& stack) {
  const ColumnGrid& grid = stack.grid();
  std::vector<int> label(grid.columns() * static_cast<std::size_t>(grid.levels), -1);
  const auto at = [&](int i, int j, int level) { return grid.index(i, j) * grid.levels + level; };
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      const ColumnRuns runs = stack.column(i, j);
      int bottom = 0;
      for (std::size_t r = 0; r < runs.count; bottom = runs.tops[r++]) {
        for (int level = bottom; level < runs.tops[r]; ++level) {
          if (runs.materials[r] != Material::kAir) label[at(i, j, level)] = 0;
        }
      }
    }
  }
  Components found;
  const double cell = grid.cell_x * grid.step * grid.cell_z;
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      bool solid = false, overhang = false;
      for (int level = 0; level < grid.levels; ++level) {
        const bool here = label[at(i, j, level)] >= 0;
        overhang = overhang || (here && (level == 0 ? false : label[at(i, j, level - 1)] < 0));
        solid = solid || here;
      }
      found.solid_columns += solid;
      found.overhang_columns += overhang;
    }
  }
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      for (int level = 0; level < grid.levels; ++level) {
        if (label[at(i, j, level)] != 0) continue;
        std::vector<std::array<int, 3>> todo{{i, j, level}};
        label[at(i, j, level)] = 1;
        std::size_t cells = 0;
        bool grounded = false;
        while (!todo.empty()) {
          const auto [a, b, c] = todo.back();
          todo.pop_back();
          ++cells;
          grounded = grounded || c == 0;
          for (const auto& [x, z, y] : {std::array{a - 1, b, c},
                                        {a + 1, b, c},
                                        {a, b - 1, c},
                                        {a, b + 1, c},
                                        {a, b, c - 1},
                                        {a, b, c + 1}}) {
            if (x < 0 || z < 0 || y < 0 || x >= grid.width || z >= grid.depth || y >= grid.levels ||
                label[at(x, z, y)] != 0)
              continue;
            label[at(x, z, y)] = 1;
            todo.push_back({x, z, y});
          }
        }
        ++found.total;
        found.solid_volume += static_cast<double>(cells) * cell;
        found.floating += grounded ? 0 : 1;
        found.floating_volume += grounded ? 0 : static_cast<double>(cells) * cell;
      }
    }
  }
  return found;
}

TEST(ComponentsTest, EqualFloodFilling) {
  for (unsigned seed = 0; seed < 24; ++seed) {
    const TerrainSource source =
        seed % 2 == 0 ? random_cells(seed, 13, 17, 11, 2, 5 + 4 * seed) : random_boxes(seed, 20, 16, 2);
    const auto built = build("layered_stack", source, seed % 2 == 0 ? 17 : 20);
    const auto& stack = dynamic_cast<const LayeredStack&>(*built);
    const Components got = find_components(stack), expected = flood(stack);
    EXPECT_EQ(got.total, expected.total);
    EXPECT_EQ(got.floating, expected.floating);
    EXPECT_EQ(got.overhang_columns, expected.overhang_columns);
    EXPECT_EQ(got.solid_columns, expected.solid_columns);
    EXPECT_NEAR(got.solid_volume, expected.solid_volume, 1e-6);
    EXPECT_NEAR(got.floating_volume, expected.floating_volume, 1e-6);
  }
}

TEST(ComponentsTest, AnArchStandsAndAnIslandFloats) {
  const TerrainSource source = from_predicate({{0, 0, 0}, {16, 16, 16}}, [](float x, float y, float z) {
    const bool ground = y < 3, pillars = y < 9 && (x < 3 || x > 13) && z > 6 && z < 10,
               deck = y >= 9 && y < 11 && z > 6 && z < 10;
    const bool island = x > 6 && x < 9 && y > 13 && z < 3;
    return ground || pillars || deck || island ? Material::kBedrock : Material::kAir;
  });
  const auto built = build("layered_stack", source, 16);
  const Components found = find_components(dynamic_cast<const LayeredStack&>(*built));
  EXPECT_EQ(found.total, 2U);
  EXPECT_EQ(found.floating, 1U);
  EXPECT_EQ(found.floating_volume, 3 * 3 * 3);
  EXPECT_EQ(found.overhang_columns, 10U * 4 + 3 * 3);
  EXPECT_EQ(found.solid_columns, 256U);
}

TEST(ComponentsTest, HeightsHaveNeitherOverhangsNorIslands) {
  const auto built = build("layered_stack", from_heights(9, 9, std::vector<float>(81, 4)));
  const Components found = find_components(dynamic_cast<const LayeredStack&>(*built));
  EXPECT_EQ(found.total, 1U);
  EXPECT_EQ(found.floating, 0U);
  EXPECT_EQ(found.overhang_columns, 0U);
}

}  // namespace
}  // namespace terrabench::test
