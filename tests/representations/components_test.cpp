#include "representations/layered_stack/components.h"

#include "tests/representations/ground.h"

namespace terrabench::test {
namespace {

// By flooding a byte grid, cell by cell.
Components flood(const LayeredStack& stack) {
  const ColumnGrid& grid = stack.grid();
  enum : char { kAir, kSolid, kSeen };
  std::vector<char> cells(grid.columns() * static_cast<std::size_t>(grid.levels), kAir);
  const auto at = [&](int i, int j, int level) -> char& {
    return cells[grid.index(i, j) * grid.levels + level];
  };
  const auto each_column = [&](const auto& visit) {
    for (int j = 0; j < grid.depth; ++j) {
      for (int i = 0; i < grid.width; ++i) visit(i, j);
    }
  };
  Components found;
  each_column([&](int i, int j) {
    stack.column(i, j).each_solid([&](int bottom, int top, Material) {
      for (int level = bottom; level < top; ++level) at(i, j, level) = kSolid;
    });
    bool solid = false, overhang = false;
    for (int level = 0; level < grid.levels; ++level) {
      solid = solid || at(i, j, level) == kSolid;
      overhang = overhang || (level > 0 && at(i, j, level) == kSolid && at(i, j, level - 1) == kAir);
    }
    found.solid_columns += solid;
    found.overhang_columns += overhang;
  });
  const double cell = grid.cell_x * grid.step * grid.cell_z;
  std::vector<std::array<int, 3>> todo;
  const auto see = [&](int i, int j, int level) {
    if (i < 0 || j < 0 || level < 0 || i >= grid.width || j >= grid.depth || level >= grid.levels) return;
    if (at(i, j, level) != kSolid) return;
    at(i, j, level) = kSeen;
    todo.push_back({i, j, level});
  };
  each_column([&](int i, int j) {
    for (int level = 0; level < grid.levels; ++level) {
      see(i, j, level);
      if (todo.empty()) continue;
      double volume = 0;
      bool grounded = false;
      while (!todo.empty()) {
        const auto [a, b, c] = todo.back();
        todo.pop_back();
        volume += cell;
        grounded = grounded || c == 0;
        for (const int way : {-1, 1}) see(a + way, b, c), see(a, b + way, c), see(a, b, c + way);
      }
      ++found.total;
      found.solid_volume += volume;
      found.floating += grounded ? 0 : 1;
      found.floating_volume += grounded ? 0 : volume;
    }
  });
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
