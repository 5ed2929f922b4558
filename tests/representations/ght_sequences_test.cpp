// Events over, in and across one another: the tree stays whole after each, an event that cannot be leaves it
// as it was to the bit, and what comes out is what the evaluation says.
#include "tests/representations/ght_agreement.h"
#include "tests/representations/ght_ground.h"

namespace terrabench::test {
namespace {

using namespace events;

// Geotectonic events all over a terrain of `size` metres with cells of `cell`.
class EventMaker {
 public:
  EventMaker(double size, double cell, unsigned seed) : size_(size), cell_(cell), random_(seed) {}

  Event next() {
    switch (random_() % 6) {
      case 0:
        return LinearErosion{point(), point(), between(0.5, 4) * cell_, between(20, 50)};
      case 1:
        return DipFault{false,          point(), point(), between(4, 14) * cell_, between(0.5, 4) * cell_,
                        between(40, 85)};
      case 2:
        return DipFault{true,           point(), point(), between(4, 14) * cell_, between(0.5, 4) * cell_,
                        between(40, 85)};
      case 3:
        return LateralFault{point(), point(), between(3, 12) * cell_, between(0.5, 8) * cell_};
      default: {
        const glm::dvec2 at = point();
        return RadialErosion{{at.x, between(18, 26) * cell_, at.y},
                             glm::dvec3(between(2, 9), between(3, 9), between(2, 9)) * cell_};
      }
    }
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  glm::dvec2 point() { return {between(0.1, 0.9) * size_, between(0.1, 0.9) * size_}; }

  double size_, cell_;
  std::mt19937 random_;
};

class Sequence : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Ght, Sequence, testing::Range(0U, 1000U));

TEST_P(Sequence, KeepsTheTreeWholeAndIsWhatTheEvaluationSays) {
  const int side = 49 + static_cast<int>(GetParam() % 3) * 16;
  const float cell = GetParam() % 2 == 0 ? 1.0F : 7.5F;
  const Heightfield ground = rolling(side, side, cell, 0.3F, GetParam());
  Ght ght = make_ght(ground);
  auto sculpture = std::make_shared<Sculpture>(Sculpture{ground, {}});
  EventMaker maker(ground.extent_x(), cell, GetParam());
  int refused = 0;
  for (int attempt = 0; attempt < 60 && sculpture->events.size() < 12; ++attempt) {
    const Event event = maker.next();
    const std::vector<std::byte> before = saved(ght);
    try {
      ght.apply(event);
      sculpture->events.push_back(event);
      if (getenv("GHTDBG")) {
        for (auto c : outline(event)) printf("(%g,%g) ", c.x / cell, c.y / cell);
        printf("%s\n", where(event, 1).c_str());
      }
      ASSERT_THAT(ght::broken_invariants(ght.model()), testing::IsEmpty())
          << "after " << where(event, attempt);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kBadInput);
      ASSERT_EQ(saved(ght), before) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(sculpture->events.size(), 3U);
  RecordProperty("refused", refused);
  expect_sound(ght);
  EXPECT_EQ(saved(*reloaded("ght", ght)), saved(ght));
  EXPECT_EQ(Agreement(ght, sculpture).disagreements(800, GetParam()), 0U)
      << sculpture->events.size() << " events";
}

}  // namespace
}  // namespace terrabench::test
