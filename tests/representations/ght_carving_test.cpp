// Tunnels and caves in the grounded heightmap tree: what they take out, their heightmaps, and what is
// refused.
#include "tests/representations/ght_ground.h"
#include "tests/representations/ght_oracle.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::test {
namespace {

using events::Carving;
using events::ridge;
using events::square_tunnel;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<Span> column(const Ght& ght, float x, float z) {
  const SpanSink sink = spans_of(ght, {std::span(&x, 1), std::span(&z, 1)});
  return {sink.all().begin(), sink.all().end()};
}

std::size_t nodes_of(const Ght& ght, ght::Area area) {
  const auto& nodes = ght.model().tree.nodes();
  return static_cast<std::size_t>(std::count_if(
      nodes.begin(), nodes.end(), [&](const ght::GroundedHeightmap& n) { return n.area == area; }));
}

TEST(GhtCarving, ATunnelGoesThrough) {
  Ght ght = make_ght(ridge());
  ght.apply(square_tunnel({20, 15, 32}, {44, 15, 32}));
  expect_sound(ght);
  EXPECT_EQ(nodes_of(ght, ght::Area::kIndoor), 4U);
  EXPECT_EQ(nodes_of(ght, ght::Area::kBorder), 2U);
  const std::vector<Span> middle = column(ght, 32.1F, 32.3F);
  ASSERT_THAT(middle, SizeIs(2));
  EXPECT_NEAR(middle[0].top, 13, 1e-5);
  EXPECT_NEAR(middle[1].bottom, 17, 1e-5);
  EXPECT_NEAR(middle[1].top, 30, 1e-5);
  const std::vector<Span> mouth = column(ght, 46.8F, 32.1F);
  ASSERT_THAT(mouth, SizeIs(1));
  EXPECT_NEAR(mouth[0].top, 13, 1e-5);
}

// Carvings of many forms through a ridge agree with the evaluation.
TEST(GhtCarving, AgreesWithTheEvaluation) {
  const std::vector<glm::dvec2> octagon = {{-1, -2}, {1, -2}, {2, -1}, {2, 1},
                                           {1, 2},   {-1, 2}, {-2, 1}, {-2, -1}};
  const auto with = [](Carving c, const auto& change) {
    change(c);
    return c;
  };
  const Carving plain = square_tunnel({20, 15, 32}, {44, 15, 32});
  const std::vector<Carving> carvings = {
      plain,
      with(plain, [](Carving& c) { c.from.z = 24, c.to.z = 41; }),
      with(plain, [](Carving& c) { c.from.y = 14, c.to.y = 16; }),
      with(plain, [](Carving& c) { c.scale_to = 0.6; }),
      with(plain, [](Carving& c) { c.roughness = 0.2, c.seed = 5; }),
      with(plain, [&](Carving& c) { c.section = octagon; }),
      with(plain, [&](Carving& c) { c.section = octagon, c.roughness = 0.05, c.scale_from = 1.3; }),
      with(plain,
           [](Carving& c) {
             c.section = {{-3, -2}, {3, -2}, {0, 2}};
           }),
      with(plain,
           [](Carving& c) {
             c.section = {{-1.5, -2}, {1.5, -2}, {3, 2}, {-3, 2}};
           }),
      with(plain, [](Carving& c) { c.cave = true, c.to.x = 33; }),
      with(plain,
           [&](Carving& c) {
             c.cave = true, c.to = {33, 12, 38}, c.section = octagon, c.scale_to = 1.5;
           }),
      with(plain, [&](Carving& c) { c.cave = true, c.from.x = 44, c.to.x = 31, c.section = octagon; }),
  };
  for (std::size_t k = 0; k < carvings.size(); ++k) {
    for (const bool rough : {false, true}) {
      SCOPED_TRACE(testing::Message() << "carving " << k << (rough ? " in rough ground" : ""));
      Heightfield ground = ridge();
      if (rough) {
        const Heightfield hills = rolling(65, 65, 1, 0.25F, 3);
        for (std::size_t c = 0; c < ground.heights.size(); ++c) ground.heights[c] += hills.heights[c] - 20;
      }
      Ght ght = make_ght(ground);
      ASSERT_NO_THROW(ght.apply(carvings[k]));
      expect_sound(ght);
      EXPECT_EQ(ght.model().tree.nodes().size(), 1 + carvings[k].section.size() + 2);
      const Disagreement found = compare(ght, events::after(ground, {carvings[k]}), 2);
      EXPECT_TRUE(found.wrong.empty()) << found;
    }
  }
}

TEST(GhtCarving, ImpossibleOnesAreRefused) {
  Ght ght = make_ght(ridge());
  EXPECT_THAT(refusal(ght, square_tunnel({12, 15, 32}, {44, 15, 32})), HasSubstr("starts in the air"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 32}, {50, 15, 32})), HasSubstr("ends in the air"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 5, 32}, {44, 5, 32})), HasSubstr("does not come out"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 5, 32}, {44, 15, 32})), HasSubstr("beyond 'from'"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 32}, {44, 5, 32})), HasSubstr("beyond 'to'"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 1.9}, {44, 15, 1.9})), HasSubstr("outside the terrain"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 3}, {44, 15, 3})), HasSubstr("border"));
  Carving thin = square_tunnel({20, 15, 32}, {44, 15, 32});
  thin.scale_to = 0.45;
  EXPECT_THAT(refusal(ght, thin), HasSubstr("less than two sample spacings"));
  Carving crossed = square_tunnel({20, 15, 32}, {44, 15, 32});
  std::swap(crossed.section[1], crossed.section[2]);
  EXPECT_THAT(refusal(ght, crossed), HasSubstr("crosses itself"));
  // Far below the ground: more cells than any terrain has room for.
  EXPECT_THAT(refusal(ght, square_tunnel({20, -1e9, 32}, {44, 15, 32})), HasSubstr("too many cells"));
  // A section that narrows to nothing before it comes out.
  Carving cone = square_tunnel({31, 15, 32}, {33, 15, 32});
  cone.scale_to = 1.4;
  EXPECT_THAT(refusal(ght, cone), HasSubstr("does not come out"));
  const events::Event valley[] = {events::LinearErosion{{32, 26}, {32, 38}, 15, 60},
                                  square_tunnel({20, 15, 32}, {44, 15, 32})};
  ght.apply(valley[0]);
  EXPECT_THAT(refusal(ght, valley[1]), HasSubstr("leaves the ground"));
  expect_sound(ght);
}

TEST(GhtCarving, KeepsToItself) {
  Ght ght = make_ght(ridge());
  ght.apply(square_tunnel({20, 15, 32}, {44, 15, 32}));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 32}, {44, 15, 32})), HasSubstr("another tunnel"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 36.5}, {44, 15, 36.5})), HasSubstr("another tunnel"));
  EXPECT_THAT(refusal(ght, square_tunnel({22, 18.5, 22}, {42, 18.5, 42})), HasSubstr("another tunnel"));
  // Events at its mouths and above it.
  EXPECT_THAT(refusal(ght, events::RadialErosion{{48, 16, 33}, {3, 3, 3}}), HasSubstr("mouth"));
  EXPECT_THAT(refusal(ght, events::LinearErosion{{18, 26}, {18, 38}, 2, 45}), HasSubstr("mouth"));
  EXPECT_THAT(refusal(ght, events::RadialErosion{{32, 30, 32}, {5, 12.5, 5}}), HasSubstr("breaks into"));
  EXPECT_THAT(refusal(ght, events::LinearErosion{{30, 32}, {34, 32}, 14, 70}), HasSubstr("breaks into"));
  // Events with enough distance above and beside it.
  ght.apply(square_tunnel({20, 15, 40}, {44, 15, 40}));
  ght.apply(events::LinearErosion{{30, 32}, {34, 32}, 6, 60});
  ght.apply(events::RadialErosion{{32, 30, 24}, {5, 6, 5}});
  expect_sound(ght);
  EXPECT_EQ(ght.model().tree.nodes().size(), 1U + 6 + 6 + 4 + 1);
  const Disagreement found =
      compare(ght, events::after(ridge(), {square_tunnel({20, 15, 32}, {44, 15, 32}),
                                           square_tunnel({20, 15, 40}, {44, 15, 40}),
                                           events::LinearErosion{{30, 32}, {34, 32}, 6, 60},
                                           events::RadialErosion{{32, 30, 24}, {5, 6, 5}}}));
  EXPECT_TRUE(found.wrong.empty()) << found;
}

// At a gully across the tunnel, outside its end, the roof comes out and goes in again before the floor comes
// out.
TEST(GhtCarving, RefusesOneThatGoesUnderAgain) {
  Heightfield ground = ridge();
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 46; i <= 54; ++i) {
      ground.heights[static_cast<std::size_t>(j * ground.width + i)] = i >= 48 && i <= 50 ? 15.0F : 22.0F;
    }
  }
  Ght ght = make_ght(ground);
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 32}, {42, 15, 32})), HasSubstr("mouth"));
}

// A cave from the high block of a fault along the crest into the air under its overhang. The topmost ground
// is still above it, so only the overhang is a reason to refuse it.
TEST(GhtCarving, KeepsFromAnOverhang) {
  const events::DipFault fault{true, {32, 40}, {32, 24}, 10, 5, 45};
  Ght ght = make_ght(ridge()), without = make_ght(ridge());
  Carving near = square_tunnel({25, 26.5, 32}, {33, 26.5, 32});
  near.cave = true;
  without.apply(near);
  ght.apply(fault);
  EXPECT_THAT(refusal(ght, near), HasSubstr("overhang"));
  ght.apply(square_tunnel({20, 15, 50}, {44, 15, 50}));
  expect_sound(ght);
}

// Each heightmap is as in the paper: walls with smooth noise along the axis, borders on the root's samples
// and void where the section is, all children of the root.
TEST(GhtCarving, NodesAreThePapers) {
  Ght ght = make_ght(ridge());
  Carving cave = square_tunnel({20, 15, 32}, {33, 15, 32});
  cave.cave = true;
  cave.roughness = 0.2;
  ght.apply(cave);
  const ght::Tree& tree = ght.model().tree;
  ASSERT_THAT(tree.nodes(), SizeIs(1 + 4 + 2));
  for (std::size_t n = 1; n < tree.nodes().size(); ++n) {
    const ght::GroundedHeightmap& node = tree.nodes()[n];
    EXPECT_EQ(node.parent, 0U);
    EXPECT_EQ(node.depth, 1U);
    double most = 0;
    std::size_t voids = 0;
    for (ght::CellId c = node.first; c < node.first + node.cells(); ++c) {
      voids += tree.kind(c) == ght::CellKind::kVoid;
      if (tree.kind(c) == ght::CellKind::kHeight) most = std::max<double>(most, std::abs(tree.height(c)));
    }
    if (node.area == ght::Area::kBorder) {
      EXPECT_TRUE(node.aligned);
      EXPECT_GT(voids, 5U);
      EXPECT_LT(voids, node.cells());
    } else if (n <= 4) {
      EXPECT_EQ(node.area, ght::Area::kIndoor);
      EXPECT_LE(most, 0.2F);
      EXPECT_GT(most, 0.02);
    }
  }
  EXPECT_EQ(nodes_of(ght, ght::Area::kBorder), 1U);
  EXPECT_EQ(nodes_of(ght, ght::Area::kIndoor), 5U);
  const auto copy = reloaded("ght", ght);
  EXPECT_EQ(saved(*copy), saved(ght));
}

}  // namespace
}  // namespace terrabench::test
