// Single events on the grounded heightmap tree: the heightmaps they add, and that the tree stays valid.
#include "tests/representations/ght_oracle.h"

namespace terrabench::test {
namespace {

using namespace events;

constexpr float kCell = 2;

struct NamedEvent {
  std::string_view name;
  Event event;
  std::size_t nodes;
};

// For 65 × 65 samples 2 m apart, along the axes and across them.
std::vector<NamedEvent> single_events() {
  return {{"linear erosion east", LinearErosion{{40, 60}, {90, 60}, 8, 30}, 4},
          {"linear erosion askew", LinearErosion{{40, 50}, {85, 83}, 7, 40}, 4},
          {"linear erosion short", LinearErosion{{60, 60}, {61, 62}, 10, 45}, 4},
          {"linear erosion shallow", LinearErosion{{30, 90}, {80, 30}, 0.5, 20}, 4},
          {"radial erosion", RadialErosion{{64, 42, 64}, {20, 12, 14}}, 1},
          {"normal fault", DipFault{false, {40, 70}, {100, 60}, 30, 8, 60}, 3},
          {"normal fault flat", DipFault{false, {60, 100}, {60, 30}, 25, 10, 20}, 3},
          {"inverse fault", DipFault{true, {40, 70}, {100, 60}, 30, 8, 60}, 3},
          {"inverse fault flat", DipFault{true, {90, 64}, {40, 64}, 35, 10, 30}, 3},
          {"inverse fault steep", DipFault{true, {50, 40}, {80, 80}, 20, 6, 89}, 3},
          {"lateral fault", LateralFault{{40, 60}, {90, 70}, 25, 12}, 2},
          {"lateral fault west", LateralFault{{90, 60}, {40, 60}, 25, 12}, 2}};
}

class SingleEvent : public testing::TestWithParam<NamedEvent> {};
INSTANTIATE_TEST_SUITE_P(Ght, SingleEvent, testing::ValuesIn(single_events()), [](const auto& at) {
  std::string name(at.param.name);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST_P(SingleEvent, AddsThePapersHeightmapsAndLeavesTheTreeWhole) {
  Ght ght = make_ght(rolling(65, 65, kCell));
  ght.apply(GetParam().event);
  EXPECT_EQ(ght.model().tree.nodes().size(), 1 + GetParam().nodes);
  expect_sound(ght);
  EXPECT_GT(ght::census(ght.model()).links, 20U);
}

TEST_P(SingleEvent, IsWhatTheEvaluationSays) {
  for (const float rough : {0.0F, 0.3F}) {
    const Heightfield ground = rolling(65, 65, kCell, rough);
    Ght ght = make_ght(ground);
    ght.apply(GetParam().event);
    Disagreement found =
        compare(ght, Evaluation(std::make_shared<Sculpture>(Sculpture{ground, {GetParam().event}})));
    // The cliff at the ends of an overhang is one sample spacing wide in the tree and has no width in the
    // evaluation.
    const std::size_t at_ends = std::erase_if(found.wrong, [](const Disagreement::Point& point) {
      return at_end_of_overhang(GetParam().event, point.at, kCell);
    });
    EXPECT_LE(at_ends, 1U);
    EXPECT_TRUE(found.wrong.empty()) << found << " roughness " << rough;
  }
}

}  // namespace
}  // namespace terrabench::test
