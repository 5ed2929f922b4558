// Change tables against the sets that they come from, and flags against both.
#include <gtest/gtest.h>

#include "lod/mrbsp/visibility/change_table.h"
#include "tests/lod/visible_ground.h"
#include "tests/terrain/errors.h"

namespace terrabench::mrbsp::visibility {
namespace {

TEST(VisibilityTable, ChangesLeadBackToTheSets) {
  const Sets sets = visible_over(65, 50);
  const ChangeTable table = changes_of(sets);
  EXPECT_EQ(sets_of(table), sets);
  EXPECT_EQ(table.steps(), 7 * 7 + 8 * 6);
}

TEST(VisibilityTable, RefusesMoreChangesThanFit) {
  // Each step toggles all 2^24 triangles: 17 steps are one too many.
  Sets sets({18, 1, 1}, kDeepestCoarse, 1.8F);
  for (std::size_t cell = 0; cell < 18; cell += 2) {
    std::fill_n(sets.bits.begin() + static_cast<std::ptrdiff_t>(cell * sets.words), sets.words,
                ~std::uint64_t{0});
  }
  EXPECT_EQ(failure_of([&] { (void)changes_of(sets); }).code, ExitCode::kUsage);
}

TEST(VisibilityFlags, FlagsStandForTheirSubtreesWhereverTheWalkGoes) {
  const ChangeTable table = table_over(65, 50);
  const Sets sets = sets_of(table);
  Flags flags(table);
  std::size_t toggled = 0;
  for (std::uint32_t k = 0; k < 40; ++k) {
    const glm::ivec2 cell(static_cast<int>(8 * random_share(2 * k)),
                          static_cast<int>(7 * random_share(2 * k + 1)));
    toggled += flags.move_to(table, cell);
    EXPECT_EQ(flags.cell(), cell);
    const NodeNumber level = first_node(table.depth);
    for (NodeNumber node = 2 * level - 1; node >= 1; --node) {
      const bool expected = node >= level
                                ? sets.sees(cell.y * 8 + cell.x, static_cast<std::uint32_t>(node - level))
                                : flags[2 * node] || flags[2 * node + 1];
      ASSERT_EQ(flags[node], expected);
    }
  }
  EXPECT_GT(toggled, 0U);
  EXPECT_EQ(flags.move_to(table, flags.cell()), 0U);
}

}  // namespace
}  // namespace terrabench::mrbsp::visibility
