// Tunnels and caves in the grounded heightmap tree: what they cut out, of how many heightmaps, and what is
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

std::string refusal(Ght& ght, const events::Event& event) {
  const std::vector<std::byte> before = saved(ght);
  std::string what;
  try {
    ght.apply(event);
    ADD_FAILURE() << "was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput);
    EXPECT_FALSE(error.advice().empty());
    what = error.what();
  }
  EXPECT_EQ(saved(ght), before);
  return what;
}

std::vector<Span> column(const Ght& ght, float x, float z) {
  const SpanSink sink = spans_of(ght, {std::span(&x, 1), std::span(&z, 1)});
  return {sink.all().begin(), sink.all().end()};
}

std::size_t nodes_of(const Ght& ght, ght::Area area) {
  const auto& nodes = ght.model().tree.nodes();
  return static_cast<std::size_t>(
      std::count_if(nodes.begin(), nodes.end(), [&](const ght::Node& n) { return n.area == area; }));
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

// Carvings of every make through a ridge, which agree with the evaluation.
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
      EXPECT_EQ(found.wrong, 0U) << "of " << found.points << ", at " << found.worst.x << " " << found.worst.y
                                 << " " << found.worst.z;
    }
  }
}

TEST(GhtCarving, ImpossibleOnesAreRefused) {
  Ght ght = make_ght(ridge());
  EXPECT_THAT(refusal(ght, square_tunnel({12, 15, 32}, {44, 15, 32})), HasSubstr("starts in the air"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 15, 32}, {50, 15, 32})), HasSubstr("ends in the air"));
  EXPECT_THAT(refusal(ght, square_tunnel({20, 5, 32}, {44, 5, 32})), HasSubstr("does not come out"));
}

}  // namespace
}  // namespace terrabench::test
