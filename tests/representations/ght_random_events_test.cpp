// Random sequences of events: an accepted event leaves a valid tree that agrees with the independent
// evaluation, a refused one leaves the tree as it was.
#include <optional>

#include "terrain/events/event_file.h"
#include "tests/representations/ght_oracle.h"
#include "tests/terrain/events_ground.h"

namespace terrabench::test {
namespace {

using namespace events;

constexpr int kShards = 10, kSequences = 1000 / kShards;

// Random numbers in [low, high).
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(double share) { return number(0, 1) < share; }

 private:
  std::mt19937 random_;
};

struct Hill {
  glm::dvec2 centre;
  double height, radius;
};

struct Ground {
  Heightfield field;
  std::vector<Hill> hills;
};

// 33 to 49 samples per side, a few hills with slopes of up to 1 in 1, and roughness.
Ground random_ground(Dice& dice) {
  Ground ground;
  Heightfield& field = ground.field;
  field.width = dice.whole(33, 49);
  field.depth = dice.whole(33, 49);
  field.cell_x = static_cast<float>(dice.chance(0.3) ? dice.number(0.5, 3) : 1);
  field.cell_z = dice.chance(0.8) ? field.cell_x : 1.25F * field.cell_x;
  const double cell = field.cell_x, rough = dice.chance(0.5) ? 0 : dice.number(0, 0.3) * cell;
  for (int h = dice.whole(1, 2); h > 0; --h) {
    ground.hills.push_back(
        {{dice.number(0.25, 0.75) * field.extent_x(), dice.number(0.25, 0.75) * field.extent_z()},
         dice.number(8, 14) * cell,
         dice.number(7, 10) * cell});
  }
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      double y = 10 * cell + rough * dice.number(-1, 1);
      for (const Hill& hill : ground.hills) {
        const glm::dvec2 away = glm::dvec2(i * field.cell_x, j * field.cell_z) - hill.centre;
        y += hill.height * std::exp(-glm::dot(away, away) / (hill.radius * hill.radius));
      }
      field.heights.push_back(static_cast<float>(y));
    }
  }
  return ground;
}

Event random_carving(Dice& dice, const Ground& ground, bool cave) {
  const double cell = std::fmax(ground.field.cell_x, ground.field.cell_z);
  const Hill& hill =
      ground.hills[static_cast<std::size_t>(dice.whole(0, static_cast<int>(ground.hills.size()) - 1))];
  const double angle = dice.number(0, 2 * std::numbers::pi);
  const glm::dvec2 along{std::cos(angle), std::sin(angle)};
  const glm::dvec2 from = hill.centre - dice.number(0.1, 0.35) * hill.radius * along,
                   to = hill.centre + dice.number(0.1, 0.35) * hill.radius * along;
  Carving carving;
  carving.cave = cave;
  // The floor is mostly above the plain around the hill, so that the carving comes out.
  const double size = dice.number(1.05, 1.4) * cell,
               y = 10 * cell + 2.1 * size + dice.number(-0.05, 0.15) * hill.height;
  carving.from = {from.x, y, from.y};
  carving.to = {to.x, y + dice.number(-0.2, 0.3) * cell, to.y};
  const int sides = dice.whole(3, 8);
  for (int k = 0; k < sides; ++k) {
    const double turn = 2 * std::numbers::pi * (k + 0.5) / sides - std::numbers::pi / 2;
    carving.section.push_back(size * std::sqrt(2.0) * glm::dvec2(std::cos(turn), std::sin(turn)));
  }
  carving.scale_from = dice.number(1, 1.3);
  carving.scale_to = dice.number(1, 1.3);
  if (dice.chance(0.5)) carving.roughness = size / 24;
  carving.seed = static_cast<std::uint64_t>(dice.whole(0, 1000));
  return carving;
}

Event random_event(Dice& dice, const Ground& ground, Kind kind) {
  const Heightfield& field = ground.field;
  const double cell = std::fmax(field.cell_x, field.cell_z);
  const glm::dvec2 size{field.extent_x(), field.extent_z()};
  const glm::dvec2 middle{dice.number(0.2, 0.8) * size.x, dice.number(0.2, 0.8) * size.y};
  const double angle = dice.chance(0.3) ? dice.whole(0, 3) * std::numbers::pi / 2 : dice.number(0, 7);
  const glm::dvec2 half = dice.number(1.5, 8) * cell * glm::dvec2(std::cos(angle), std::sin(angle));
  const glm::dvec2 from = middle - half, to = middle + half;
  const double extent = dice.number(3, 9) * cell;
  switch (kind) {
    case Kind::kLinearErosion:
      return LinearErosion{from, to, dice.number(0.3, 3) * cell, dice.number(20, 60)};
    case Kind::kRadialErosion:
      return RadialErosion{
          {middle.x, field.sample(static_cast<float>(middle.x), static_cast<float>(middle.y)), middle.y},
          {dice.number(1, 6) * cell, dice.number(0.5, 4) * cell, dice.number(1, 6) * cell}};
    case Kind::kNormalFault:
      return DipFault{false, from, to, extent, dice.number(0.3, 4) * cell, dice.number(40, 85)};
    case Kind::kInverseFault:
      return DipFault{true, from, to, extent, dice.number(0.3, 4) * cell, dice.number(40, 85)};
    case Kind::kLateralFault:
      return LateralFault{from, to, extent, dice.number(0.3, 4) * cell};
    default:
      return random_carving(dice, ground, kind == Kind::kCave);
  }
}

struct Shares {
  std::array<int, kKinds> tried{}, accepted{};
  int borderline = 0;  // sequences with a carving that only the evaluation, at other samples, refuses
};

// Whether the tree took the event. It is valid then, and otherwise as it was.
bool takes(Ght& ght, const Event& event) {
  const std::vector<std::byte> before = saved(ght);
  try {
    ght.apply(event);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kBadInput) << error.what();
    EXPECT_EQ(saved(ght), before) << error.what();
    return false;
  }
  EXPECT_THAT(ght::broken_invariants(ght.model()), testing::IsEmpty()) << name(kind(event));
  return true;
}

// One sequence; adds its tried and accepted events to the shares.
void run(unsigned seed, Shares& shares) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Dice dice(seed);
  const Ground ground = random_ground(dice);
  Ght ght = make_ght(ground.field);
  std::vector<Event> done;
  for (int left = dice.whole(1, 8); left > 0; --left) {
    const auto kind = static_cast<std::size_t>(dice.whole(0, kKinds - 1));
    const Event event = random_event(dice, ground, static_cast<Kind>(kind));
    ++shares.tried[kind];
    if (!takes(ght, event)) continue;
    ++shares.accepted[kind];
    done.push_back(event);
  }
  ASSERT_TRUE(check_edges(ght.mesh({})).watertight());
  std::optional<Evaluation> truth;
  try {
    truth.emplace(after(ground.field, done));
  } catch (const EventError& error) {
    ASSERT_TRUE(std::holds_alternative<Carving>(done[error.number() - 1])) << error.what();
    ++shares.borderline;
    return;
  }
  const Disagreement found = compare(ght, *truth);
  ASSERT_TRUE(found.wrong.empty()) << found << "\n" << to_text(done);
}

// A dozen geotectonic events, on three sizes of ground and two of cells.
void run_dozen(unsigned seed, Disagreement& sum) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Dice dice(seed);
  const int side = 49 + static_cast<int>(seed % 3) * 16;
  const Ground ground{rolling(side, side, seed % 2 == 0 ? 1.0F : 7.5F, 0.3F, seed), {}};
  Ght ght = make_ght(ground.field);
  auto sculpture = std::make_shared<Sculpture>(Sculpture{ground.field, {}});
  for (int attempt = 0; attempt < 60 && sculpture->events.size() < 12; ++attempt) {
    const Event event = random_event(dice, ground, static_cast<Kind>(dice.whole(0, 4)));
    if (takes(ght, event)) sculpture->events.push_back(event);
  }
  ASSERT_GT(sculpture->events.size(), 3U);
  expect_sound(ght);
  ASSERT_EQ(saved(*reloaded("ght", ght)), saved(ght));
  const Disagreement found = compare(ght, sculpture);
  ASSERT_TRUE(found.wrong.empty()) << found << "\n" << to_text(sculpture->events);
  sum.points += found.points;
  sum.explained += found.explained;
}

class GhtRandomEvents : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Shard, GhtRandomEvents, testing::Range(0, kShards));

// 100 sequences per shard, a thousand in all.
TEST_P(GhtRandomEvents, KeepAllInvariantsAndAgreeWithTheEvaluation) {
  Shares shares;
  for (int s = 0; s < kSequences && !HasFailure(); ++s) {
    run(static_cast<unsigned>(GetParam() * kSequences + s + 1), shares);
  }
  // The least share that must be accepted, so that refusing everything fails.
  constexpr std::array<double, kKinds> kLeast = {0.5, 0.6, 0.4, 0.4, 0.4, 0.15, 0.25};
  for (std::size_t k = 0; k < kKinds; ++k) {
    const std::string kind(name(static_cast<Kind>(k)));
    EXPECT_GT(shares.tried[k], 40) << kind;
    EXPECT_GE(shares.accepted[k], kLeast[k] * shares.tried[k]) << kind;
    RecordProperty(kind, std::to_string(shares.accepted[k]) + " of " + std::to_string(shares.tried[k]));
  }
  EXPECT_LE(shares.borderline, 2);
}

TEST_P(GhtRandomEvents, OverAndAcrossOneAnotherAreWhatTheEvaluationSays) {
  Disagreement sum;
  for (int s = 0; s < kSequences && !HasFailure(); ++s) {
    run_dozen(static_cast<unsigned>(GetParam() * kSequences + s), sum);
  }
  // Points that pass only the forgiving comparison must be rare.
  RecordProperty("explained", std::to_string(sum.explained) + " of " + std::to_string(sum.points));
  EXPECT_LE(sum.explained, 2U) << sum.explained << " of " << sum.points;
}

// The comparison can fail: it sees a missing event of every kind.
TEST(GhtOracle, SeesAMissingEvent) {
  std::array<int, kKinds> seen{};
  Dice dice(1);
  for (std::size_t k = 0; k < kKinds; ++k) {
    for (int attempt = 0; attempt < 60 && seen[k] == 0; ++attempt) {
      const Ground ground = random_ground(dice);
      Ght ght = make_ght(ground.field);
      Event event = random_event(dice, ground, static_cast<Kind>(k));
      // A slip of two cells to either side, on slopes of about 1 in 1, is mostly within the tolerance.
      if (auto* const fault = std::get_if<LateralFault>(&event)) fault->slip *= 4;
      try {
        ght.apply(event);
      } catch (const Error&) {
        continue;
      }
      const auto without = std::make_shared<const Sculpture>(Sculpture{ground.field, {}});
      seen[k] += !compare(ght, Evaluation(without)).wrong.empty() && !compare(ght, without).wrong.empty();
    }
    EXPECT_EQ(seen[k], 1) << name(static_cast<Kind>(k));
  }
}

// The forgiving comparison, which moves faults about, sees a missing event among faults as well.
TEST(GhtOracle, SeesAMissingEventOfASequence) {
  const Heightfield ground = rolling(65, 65, 1, 0.3F, 7);
  const std::vector<Event> all = {
      DipFault{true, {14, 20}, {30, 16}, 9, 3, 60}, DipFault{false, {36, 44}, {50, 46}, 9, 3, 60},
      LinearErosion{{40, 20}, {50, 24}, 3, 40}, LateralFault{{14, 44}, {26, 46}, 7, 14},
      RadialErosion{{24, 18, 32}, {6, 5, 6}}};
  Ght ght = make_ght(ground);
  for (const Event& event : all) ght.apply(event);
  EXPECT_TRUE(compare(ght, std::make_shared<const Sculpture>(Sculpture{ground, all})).wrong.empty());
  for (std::size_t left_out = 0; left_out < all.size(); ++left_out) {
    std::vector<Event> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    EXPECT_FALSE(compare(ght, std::make_shared<const Sculpture>(Sculpture{ground, others})).wrong.empty())
        << name(kind(all[left_out]));
  }
}

// §4.2, figure 24: each particle crashes into the current ground, as a radial erosion of its size.
TEST(GhtParticles, ARainOfThemIsWhatTheEvaluationSays) {
  const Heightfield field = rolling(97, 81, 2, 0.2F, 4);
  Ght ght = make_ght(field);
  std::vector<Event> done;
  Dice dice(5);
  for (int particle = 0; particle < 600; ++particle) {
    const double radius = dice.number(2.5, 9);
    const auto x = static_cast<float>(dice.number(10, field.extent_x() - 10)),
               z = static_cast<float>(dice.number(10, field.extent_z() - 10));
    const float ground = ght.model().surface.top(ght.model().tree, {x, z});
    done.push_back(RadialErosion{{x, ground, z}, {radius, 0.3 * radius, radius}});
    ASSERT_NO_THROW(ght.apply(done.back())) << particle;
  }
  expect_sound(ght);
  EXPECT_EQ(ght.model().tree.nodes().size(), 601U);
  const Disagreement found = compare(ght, after(field, done), 2);
  EXPECT_TRUE(found.wrong.empty()) << found;
  const SpanSink spans = spans_of(ght, Lattice(ght.bounds(), 50, 50).columns());
  EXPECT_EQ(spans.all().size(), 2500U);  // one span each
}

}  // namespace
}  // namespace terrabench::test
