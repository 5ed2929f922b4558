// The boundary links that the tree stores (§3.2): a hash table, and what it holds after any sequence of
// events.
#include <map>
#include <memory>

#include "representations/ght/boundary_links.h"
#include "tests/representations/ght_ground.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::test {
namespace {

using namespace ght;

TEST(GhtBoundaryLinks, TheTableIsAMap) {
  BoundaryLinks links;
  std::map<CellId, CellId> expected;
  std::mt19937 random(3);
  EXPECT_EQ(links.of(7), kNone);
  links.erase(7);
  for (int step = 0; step < 20000; ++step) {
    const CellId c = random() % 700 * (step % 3 == 0 ? 4096 : 1);  // many collisions
    if (random() % 3 == 0) {
      links.erase(c);
      expected.erase(c);
    } else {
      links.prepare(1);
      links.set(c, static_cast<CellId>(step));
      expected[c] = static_cast<CellId>(step);
    }
    ASSERT_EQ(links.size(), expected.size());
    if (step % 500 != 0) continue;
    for (const auto& [cell, target] : expected) ASSERT_EQ(links.of(cell), target);
    std::size_t seen = 0;
    links.each([&](CellId cell, CellId target) { seen += expected.at(cell) == target; });
    ASSERT_EQ(seen, expected.size());
  }
}

std::map<CellId, CellId> all_links(const Model& model) {
  std::map<CellId, CellId> all;
  model.links.each([&](CellId c, CellId to) { all[c] = to; });
  return all;
}

// A block's edge stores links to the ground beside it, which stays the root's; a later event on it changes
// the links of earlier heightmaps too.
TEST(GhtBoundaryLinks, FollowLaterEvents) {
  Ght ght = make_ght(rolling(65, 65));
  EXPECT_EQ(ght.model().links.size(), 0U);
  ght.apply(events::DipFault{false, {20, 34}, {44, 30}, 12, 3, 60});
  const std::map<CellId, CellId> before = all_links(ght.model());
  const Tree& tree = ght.model().tree;
  std::size_t to_root = 0;
  for (const auto& [c, to] : before) {
    EXPECT_NE(tree.node_of(c), tree.node_of(to));
    EXPECT_GE(c, tree.nodes()[0].cells());
    to_root += tree.node_of(to) == 0;
    EXPECT_LE(glm::distance(tree.position(c), tree.position(to)), 4) << "not a neighbour";
  }
  EXPECT_GT(to_root, 60U);

  ght.apply(events::RadialErosion{{32, tree.position(tree.at_sample(32, 40)).y, 40}, {6, 3, 6}});
  std::size_t changed = 0;
  for (const auto& [c, to] : all_links(ght.model())) {
    changed += tree.node_of(c) <= 3 && tree.node_of(to) == 4;
  }
  EXPECT_GT(changed, 10U);
  expect_sound(ght);
}

// Craters in craters on plain ground, where no face joins the heightmaps.
TEST(GhtBoundaryLinks, OfCratersOnPlainGround) {
  Ght ght = make_ght(rolling(65, 65));
  const auto crater = [&](float x, float z, double radius) {
    const float y = ght.model().surface.top(ght.model().tree, {x, z});
    ght.apply(events::RadialErosion{{x, y, z}, {radius, 0.4 * radius, radius}});
    EXPECT_EQ(check_boundary_links(ght.model()).wrong, 0U);
  };
  crater(30, 30, 9);
  const std::size_t one = ght.model().links.size();
  EXPECT_GT(one, 40U);
  crater(31, 29, 3);  // inside: links both ways
  EXPECT_GT(ght.model().links.size(), one + 20);
  crater(38, 30, 5);   // across the edge
  crater(30, 30, 18);  // over all of them: the old links go
  const Tree& tree = ght.model().tree;
  for (const auto& [c, to] : all_links(ght.model())) EXPECT_EQ(tree.node_of(c), 4U) << c << ' ' << to;
  EXPECT_EQ(ght.model().surface.faces(), 0U);
  expect_sound(ght);
}

TEST(GhtBoundaryLinks, AreMadeAgainOnLoading) {
  Ght ght = make_ght(events::ridge());
  ght.apply(events::square_tunnel({20, 15, 32}, {44, 15, 32}));
  ght.apply(events::DipFault{true, {24, 50}, {40, 52}, 6, 2, 50});
  ght.apply(events::LinearErosion{{28, 12}, {38, 13}, 1.5, 40});
  const auto copy = reloaded("ght", ght);
  const Model& loaded = dynamic_cast<const Ght&>(*copy).model();
  EXPECT_EQ(all_links(loaded), all_links(ght.model()));
  EXPECT_EQ(check_boundary_links(loaded).wrong, 0U);
}

// All slots are counted, and few are spare.
TEST(GhtBoundaryLinks, AreCountedInMemory) {
  const auto held = std::make_unique<Ght>(make_ght(rolling(65, 65)));  // memory() asks the allocator
  Ght& ght = *held;
  const std::size_t fresh = ght.memory().total();
  ght.apply(events::RadialErosion{{32, 24, 32}, {12, 9, 12}});
  const Memory links = ght.model().links.memory();
  EXPECT_GE(links.total(), 8 * ght.model().links.size());
  EXPECT_LE(links.total(), 8 * 10 * ght.model().links.size());
  EXPECT_GE(ght.memory().total(), fresh + links.total());
}

}  // namespace
}  // namespace terrabench::test
