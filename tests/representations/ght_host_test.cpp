// Carvings in ground that earlier events made (the paper carves the root only): on the wall of a fault, on
// its blocks, and on the floor of a cave.
#include "tests/representations/ght_ground.h"
#include "tests/representations/ght_oracle.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::test {
namespace {

using events::Carving;
using events::square_tunnel;
using testing::HasSubstr;

Heightfield flat(int side, float height) {
  Heightfield field{side, side, 1, 1, {}, {}};
  field.heights.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), height);
  return field;
}

// Raises the north of a plain by half of `rise` and lowers its south as much; the scarp between faces south.
events::DipFault scarp(double rise, double dip) { return {false, {12, 32}, {52, 32}, 24, rise, dip}; }

// A cave from the south into the scarp, half way up it.
Carving cave_into_scarp(double dip) {
  Carving cave = square_tunnel({32, 20, 32 - 4 / std::tan(dip * std::numbers::pi / 180)}, {32, 20, 24});
  cave.cave = true;
  cave.section = {{-1.3, -1.3}, {1.3, -1.3}, {1.3, 1.3}, {-1.3, 1.3}};
  return cave;
}

// The wall of a fault is a heightmap on an inclined plane: the carving becomes its child, and is what the
// evaluation says.
TEST(GhtHost, ACaveInTheWallOfAFault) {
  for (const double dip : {45.0, 55.0, 65.0}) {
    SCOPED_TRACE(dip);
    const Heightfield ground = flat(65, 20);
    Ght ght = make_ght(ground);
    const events::DipFault fault = scarp(14, dip);
    ght.apply(fault);
    const Carving cave = cave_into_scarp(dip);
    ASSERT_NO_THROW(ght.apply(cave));
    const ght::Tree& tree = ght.model().tree;
    const ght::Applied& last = tree.events().back();
    EXPECT_EQ(last.host, 3U) << "not the scarp";
    EXPECT_EQ(tree.nodes()[last.first].depth, 2U);
    for (ght::NodeId n = last.first; n < last.first + last.nodes; ++n) EXPECT_EQ(tree.nodes()[n].parent, 3U);
    expect_sound(ght);
    const Disagreement found = compare(ght, events::after(ground, {fault, cave}), 2);
    EXPECT_TRUE(found.wrong.empty()) << found;
    const auto copy = reloaded("ght", ght);
    EXPECT_EQ(saved(*copy), saved(ght));
  }
}

// The host holds the whole region: a tunnel with one mouth on a fault and one beyond it belongs to the root.
TEST(GhtHost, ATunnelFromAFaultToTheRootBelongsToTheRoot) {
  Ght ght = make_ght(events::ridge());
  ght.apply(events::DipFault{false, {15, 20}, {15, 44}, 8, 1, 60});
  ASSERT_NO_THROW(ght.apply(square_tunnel({22, 15, 32}, {44, 15, 32})));
  EXPECT_EQ(ght.model().tree.events().back().host, 0U);
  expect_sound(ght);
}

// Where it cannot be, the error names what is in the way.
TEST(GhtHost, RefusalsNameTheGeometry) {
  // Down from the floor of a cave, and up into it.
  Ght carved = make_ght(events::ridge());
  Carving cave = square_tunnel({20, 15, 32}, {36, 15, 32});
  cave.cave = true;
  carved.apply(cave);
  Carving shaft = square_tunnel({26, 8, 32}, {28, 9, 32});
  shaft.cave = true;
  shaft.from = {28, 9, 32};
  shaft.to = {34, 5, 32};
  EXPECT_THAT(refusal(carved, shaft), HasSubstr("another tunnel or cave"));
  EXPECT_THAT(refusal(carved, events::RadialErosion{{17, 17, 32}, {3, 3, 3}}),
              HasSubstr("mouth of a tunnel"));

  // Under the overhang of an inverse fault.
  Ght folded = make_ght(flat(65, 20));
  folded.apply(events::DipFault{true, {12, 32}, {52, 32}, 24, 14, 60});
  EXPECT_THAT(refusal(folded, cave_into_scarp(60)), HasSubstr("overhang"));
}

}  // namespace
}  // namespace terrabench::test
