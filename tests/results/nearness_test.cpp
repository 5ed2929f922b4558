#include "results/claims/nearness.h"

#include <gmock/gmock.h>

#include <limits>

namespace terrabench {
namespace {

using testing::DoubleNear;
using testing::Optional;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

auto near(double room) { return Optional(DoubleNear(room, 1e-9)); }

std::optional<double> room(double value, double low, double high,
                           Condition::Kind kind = Condition::Kind::kRatio) {
  Condition condition;
  condition.kind = kind;
  condition.low = low;
  condition.high = high;
  return room_in_range(value, condition);
}

TEST(Nearness, OfARangeTheNearerBoundCounts) {
  EXPECT_THAT(room(0.5, 0.5, 2), near(0));
  EXPECT_THAT(room(2, 0.5, 2), near(0));
  EXPECT_THAT(room(1, 0.5, 2), near(0.5));
  EXPECT_THAT(room(1000, 1, 1e9), near(0.999));
  EXPECT_THAT(room(-0.5, -1, 1), near(0.5));
  EXPECT_THAT(room(0.5, -1, 1), near(0.5));
}

TEST(Nearness, OneBoundIsComparedByRatio) {
  EXPECT_THAT(room(4, 1, kInfinity), near(0.75));
  EXPECT_THAT(room(1, -kInfinity, 4), near(0.75));
  EXPECT_THAT(room(1, 0, 4), near(0.75));
  EXPECT_THAT(room(0, 0, 4), near(1));
  EXPECT_THAT(room(1, 1, kInfinity), near(0));
  EXPECT_EQ(room_between(1, 4), 0.75);
  EXPECT_EQ(room_between(-4, -1), 0.75);
  EXPECT_EQ(room_between(-1, 4), 1);
  EXPECT_EQ(room_between(0, 4), 1);
  EXPECT_EQ(room_between(1, kInfinity), 1);
}

// A narrow range on both sides of the value, and a bound far below it.
TEST(Nearness, RangesAndOrdersAreComparedByOneMeasure) {
  EXPECT_THAT(room(1, 0.95, 1.05), near(0.05 / 1.05));
  EXPECT_THAT(room(100, 1, kInfinity), near(0.99));
  EXPECT_EQ(room_between(1, 100), 0.99);
}

TEST(Nearness, TheBestShareIsNotNearABound) {
  constexpr auto kWithin = Condition::Kind::kWithin;
  EXPECT_THAT(room(1, 0.85, 1, kWithin), near(0.15));
  EXPECT_THAT(room(0.9, 0.85, 1, kWithin), near(0.05 / 0.9));
  EXPECT_THAT(room(0, 0, 0.2, kWithin), near(1));
  EXPECT_THAT(room(1, 0.85, 1), near(0)) << "a ratio may exceed 1";
  EXPECT_THAT(room(1, -1, 1, kWithin), near(0)) << "no share";
}

TEST(Nearness, ARangeOfOneValueAndOneWithoutBoundsHaveNoRoom) {
  EXPECT_EQ(room(1, 1, 1), std::nullopt);
  EXPECT_EQ(room(1, -kInfinity, kInfinity), std::nullopt);
  EXPECT_EQ(room(1, 0, kInfinity), std::nullopt);
}

}  // namespace
}  // namespace terrabench
