#include "experiments/interference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace terrabench {
namespace {

using ::testing::ElementsAre;

// Seconds of loops beside which a sample counts as undisturbed or not, whatever this machine does.
constexpr double kCalm = 0, kSlow = 1;

TEST(Interference, ASlowLoopIsAFifthAboveTheShortest) {
  ASSERT_GT(loop_seconds(), 0);
  ASSERT_LT(shortest_loop(), kSlow / 2);
  EXPECT_FALSE(disturbed(1.19 * shortest_loop()));
  EXPECT_TRUE(disturbed(1.21 * shortest_loop()));
}

TEST(Turns, EndWhenEnoughAreUndisturbed) {
  loop_seconds();
  Turns turns;
  for (const double loop : {kSlow, kCalm, kSlow, kCalm}) {
    EXPECT_TRUE(turns.more(3));
    turns.add({static_cast<double>(turns.taken())}, loop);
  }
  EXPECT_TRUE(turns.more(3));
  EXPECT_FALSE(turns.more(2));
  turns.add({4.0}, kCalm);
  EXPECT_FALSE(turns.more(3));
  EXPECT_EQ(turns.undisturbed(), 3U);
  EXPECT_THAT(turns.kept(3), ElementsAre(ElementsAre(1), ElementsAre(3), ElementsAre(4)));
  EXPECT_EQ(turns.kept(4).size(), 5U) << "too few without the disturbed ones";
}

TEST(Turns, TakeAtMostTwiceWhatIsWanted) {
  loop_seconds();
  Turns turns;
  while (turns.more(3)) turns.add({1}, kSlow);
  EXPECT_EQ(turns.taken(), 6U);
  EXPECT_EQ(turns.kept(3).size(), 6U);
}

TEST(Turns, TakeOnceWhatIsWantedOnce) {
  loop_seconds();
  Turns turns;
  turns.add({1}, kSlow);
  EXPECT_FALSE(turns.more(1));
}

// A loop is slow once, between the second sample and the third: both are disturbed.
TEST(Turns, AreJudgedByTheLoopsBeforeAndAfter) {
  loop_seconds();
  Turns turns;
  int loops = 0, taken = 0;
  take_turns(
      turns, 3, [&] { return std::vector{static_cast<double>(taken++)}; },
      [&] { return ++loops == 3 ? kSlow : kCalm; });
  EXPECT_THAT(turns.kept(3), ElementsAre(ElementsAre(0), ElementsAre(3), ElementsAre(4)));
}

}  // namespace
}  // namespace terrabench
