// Invalid events: each gives an error that says what to do, and leaves the tree as it was, to the bit.
#include <limits>

#include "tests/representations/ght_ground.h"

namespace terrabench::test {
namespace {

using namespace events;

struct Impossible {
  std::string_view name, says;
  Event event;
};

Carving tunnel(std::vector<glm::dvec2> section) {
  Carving carving;
  carving.from = {20, 19, 32};
  carving.to = {44, 19, 32};
  carving.section = std::move(section);
  return carving;
}

std::vector<Impossible> impossible_events() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = HUGE_VAL;
  return {
      {"linear erosion outside", "outside the terrain", LinearErosion{{-5, 30}, {20, 30}, 2, 30}},
      {"radial erosion outside", "outside the terrain", RadialErosion{{64, 20, 64}, {4, 4, 4}}},
      {"dip fault far outside", "outside the terrain", DipFault{false, {500, 500}, {520, 500}, 10, 2, 60}},
      {"lateral fault from outside", "outside the terrain", LateralFault{{4, 30}, {40, 30}, 5, 20}},
      {"linear erosion without length", "one point", LinearErosion{{30, 30}, {30, 30}, 2, 30}},
      {"dip fault without length", "one point", DipFault{true, {30, 30}, {30, 30}, 5, 2, 60}},
      {"lateral fault without length", "one point", LateralFault{{30, 30}, {30, 30}, 5, 2}},
      {"linear erosion without depth", "'depth' must be above 0, got 0",
       LinearErosion{{20, 30}, {40, 30}, 0, 30}},
      {"linear erosion upright", "'slope' must be from 1 to 89 degrees, got 90",
       LinearErosion{{20, 30}, {40, 30}, 2, 90}},
      {"radial erosion without radius", "'radii' must be above 0, got 0",
       RadialErosion{{30, 20, 30}, {4, 0, 4}}},
      {"radial erosion of negative radius", "'radii' must be above 0, got -4",
       RadialErosion{{30, 20, 30}, {-4, 4, 4}}},
      {"radial erosion in the air", "does not reach the ground", RadialErosion{{30, 60, 30}, {4, 4, 4}}},
      {"radial erosion of no number", "'centre'", RadialErosion{{kNan, 20, 30}, {4, 4, 4}}},
      {"linear erosion of no end", "'to'", LinearErosion{{20, 30}, {kInfinity, 30}, 2, 30}},
      {"dip fault all scarp", "leaves no ground of the blocks",
       DipFault{false, {20, 30}, {40, 30}, 2, 9, 45}},
      {"at the border", "border", LinearErosion{{2.2, 30}, {20, 30}, 1, 30}},
      {"section of two points", "got 2", tunnel({{-2, 0}, {2, 0}})},
      {"section clockwise", "clockwise", tunnel({{-2, -2}, {-2, 2}, {2, 2}, {2, -2}})}};
}

class ImpossibleEvent : public testing::TestWithParam<Impossible> {};
INSTANTIATE_TEST_SUITE_P(Ght, ImpossibleEvent, testing::ValuesIn(impossible_events()), [](const auto& at) {
  std::string name(at.param.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

// On a tree with events.
TEST_P(ImpossibleEvent, IsNamedAndLeavesTheTreeAsItWas) {
  Ght ght = make_ght(rolling(65, 65));
  ght.apply(LinearErosion{{20, 20}, {40, 40}, 3, 35});
  ght.apply(RadialErosion{{30, 20, 30}, {6, 3, 5}});
  EXPECT_THAT(refusal(ght, GetParam().event), testing::AllOf(testing::HasSubstr(std::string(GetParam().says)),
                                                             testing::HasSubstr("event 3")));
}

TEST(GhtLimits, TheRootCountsToo) {
  TerrainSource source;
  source.name = "ground";
  source.heights = rolling(33, 33);
  Parameters parameters(Ght::parameters());
  Progress progress;
  parameters.set("most_cells", std::int64_t{33 * 33});
  EXPECT_NO_THROW(Ght::build(source, parameters, progress));
  parameters.set("most_cells", std::int64_t{33 * 33 - 1});
  const Failure failure = failure_of([&] { Ght::build(source, parameters, progress); });
  EXPECT_EQ(failure.code, ExitCode::kEnvironment);
  EXPECT_THAT(failure.advice, testing::HasSubstr("most_cells"));
}

// Erosion inside erosion until no cells are left: each event is applied completely or not at all.
TEST(GhtLimits, NestingEndsWithAnErrorAndAWholeTree) {
  for (const bool linear : {false, true}) {
    Ght ght = make_ght(rolling(33, 33));
    ght.limit_cells(6000);
    bool full = false;
    for (int depth = 0; depth < 1000 && !full; ++depth) {
      const std::vector<std::byte> before = saved(ght);
      const double y = 18 - 0.01 * depth;
      const Event event = linear ? Event(LinearErosion{{14, 16}, {18, 16}, 2, 30})
                                 : Event(RadialErosion{{16, y, 16}, {6, 3, 6}});
      try {
        ght.apply(event);
      } catch (const Error& error) {
        full = true;
        EXPECT_EQ(error.code(), ExitCode::kEnvironment) << error.what();
        EXPECT_THAT(std::string(error.advice()), testing::HasSubstr("most_cells"));
        EXPECT_EQ(saved(ght), before);
      }
    }
    EXPECT_TRUE(full);
    EXPECT_GT(ght.model().tree.events().size(), 10U);
    EXPECT_LE(ght.model().tree.cells(), 6000U);
    expect_sound(ght);
  }
}

}  // namespace
}  // namespace terrabench::test
