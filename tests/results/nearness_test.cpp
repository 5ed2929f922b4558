#include "results/nearness.h"

#include <gmock/gmock.h>

#include <limits>

namespace terrabench {
namespace {

using testing::DoubleNear;
using testing::Optional;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

auto near(double room) { return Optional(DoubleNear(room, 1e-9)); }

TEST(Nearness, ARangeHasNoRoomAtItsBoundsAndAllInItsMiddle) {
  EXPECT_THAT(room_in_range(0.5, 0.5, 2), near(0));
  EXPECT_THAT(room_in_range(2, 0.5, 2), near(0));
  EXPECT_THAT(room_in_range(1, 0.5, 2), near(1));
  EXPECT_THAT(room_in_range(1000, 1, 1e9), near(2.0 / 3));
  EXPECT_THAT(room_in_range(-0.5, -1, 1), near(0.5));
  EXPECT_THAT(room_in_range(0.5, -1, 1), near(0.5));
}

TEST(Nearness, OneBoundIsComparedByRatio) {
  EXPECT_THAT(room_in_range(4, 1, kInfinity), near(0.75));
  EXPECT_THAT(room_in_range(1, -kInfinity, 4), near(0.75));
  EXPECT_THAT(room_in_range(1, 0, 4), near(0.75));
  EXPECT_THAT(room_in_range(0, 0, 4), near(1));
  EXPECT_THAT(room_in_range(1, 1, kInfinity), near(0));
  EXPECT_EQ(room_between(1, 4), 0.75);
  EXPECT_EQ(room_between(-4, -1), 0.75);
  EXPECT_EQ(room_between(-1, 4), 1);
  EXPECT_EQ(room_between(0, 4), 1);
  EXPECT_EQ(room_between(1, kInfinity), 1);
}

TEST(Nearness, ARangeOfOneValueAndOneWithoutBoundsHaveNoRoom) {
  EXPECT_EQ(room_in_range(1, 1, 1), std::nullopt);
  EXPECT_EQ(room_in_range(1, -kInfinity, kInfinity), std::nullopt);
  EXPECT_EQ(room_in_range(1, 0, kInfinity), std::nullopt);
}

}  // namespace
}  // namespace terrabench
