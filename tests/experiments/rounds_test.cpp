#include "experiments/cross/lod/rounds.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace terrabench::cross {
namespace {

// Loops that let no sample count as disturbed, and every sample, whatever this machine does.
constexpr auto kCalm = [] { return 0.0; };
constexpr auto kSlow = [] { return 1.0; };

// Until a real loop was timed, none counts as slow.
class RoundsTest : public ::testing::Test {
 protected:
  void SetUp() override { loop_seconds(); }
};

TEST_F(RoundsTest, DoEachPieceOnceARound) {
  std::string order;
  Rounds rounds(1e9, Rounds::kFew, kCalm);
  rounds.time("a", [&] { order += 'a'; });
  rounds.sample({"b", "c"}, "1/s", [&] {
    order += 'b';
    return std::vector{static_cast<double>(order.size()), 1.0};
  });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(order, "abababababab");
  EXPECT_EQ(record.find("a")->unit, "s");
  EXPECT_EQ(record.find("a")->samples.size(), std::size_t{Rounds::kMost});
  EXPECT_EQ(record.find("b")->unit, "1/s");
  EXPECT_EQ(record.find("c")->samples, std::vector<double>(Rounds::kMost, 1));
  EXPECT_EQ(record.find("b")->samples, (std::vector<double>{2, 4, 6, 8, 10, 12}));
}

TEST_F(RoundsTest, DoLongWorkOnce) {
  std::string order;
  Rounds rounds(0);
  rounds.time("a", [&] { order += 'a'; });
  rounds.time("b", [&] { order += 'b'; });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(order, "ab");
}

TEST_F(RoundsTest, TakeFewSamplesOfShortWorkThatIsLongToPrepare) {
  std::string order;
  Rounds rounds(0.05, 2, kCalm);
  const auto prepare = [] { std::this_thread::sleep_for(std::chrono::milliseconds(60)); };
  rounds.sample("a", "s", [&] {
    prepare();
    order += 'a';
    return 0.0;  // measured
  });
  rounds.sample("b", "1/s", [&] {
    prepare();
    order += 'b';
    return 0.0;
  });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(order, "aba");
}

// The moments before and after each piece: the third sample is taken beside other work.
TEST_F(RoundsTest, TakeDisturbedSamplesAgainAndLeaveThemOut) {
  int moment = 0, taken = 0;
  Rounds rounds(1e9, Rounds::kFew, [&] { return ++moment == 6 ? 1.0 : 0.0; });
  rounds.sample("a", "s", [&] { return static_cast<double>(taken++); });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(record.find("a")->samples, (std::vector<double>{0, 1, 3, 4, 5, 6}));
  EXPECT_EQ(record.find("left_out_samples")->samples, std::vector<double>{1});
  EXPECT_EQ(record.find("disturbed_samples")->samples, std::vector<double>{0});
}

TEST_F(RoundsTest, KeepAllSamplesWhereOtherWorkNeverRests) {
  int taken = 0;
  Rounds rounds(1e9, Rounds::kFew, kSlow);
  rounds.sample("a", "s", [&] { return static_cast<double>(taken++); });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(record.find("a")->samples.size(), std::size_t{2 * Rounds::kMost});
  EXPECT_EQ(record.find("left_out_samples")->samples, std::vector<double>{0});
  EXPECT_EQ(record.find("disturbed_samples")->samples, std::vector<double>{2 * Rounds::kMost});
}

// Undisturbed samples that are fewer than `few` do not stand alone.
TEST_F(RoundsTest, KeepAllWhereTooFewAreUndisturbed) {
  for (const int calm : {4, 5}) {
    int moment = 0, taken = 0;
    Rounds rounds(1e9, 5, [&] { return (++moment + 1) / 2 <= calm ? 0.0 : 1.0; });
    rounds.sample("a", "s", [&] { return static_cast<double>(taken++); });
    Record record;
    Recorder recorder(record, "");
    rounds.run(recorder);
    EXPECT_EQ(record.find("a")->samples.size(), calm == 5 ? 5U : 2U * Rounds::kMost);
  }
}

TEST_F(RoundsTest, TakeFewSamplesOfWorkThatAddsUp) {
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.0}, 1), Rounds::kMost);
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.2}, 1), Rounds::kFew);
  EXPECT_EQ(Rounds::most_rounds({1.1, 1.1}, 1), 1);
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.2}, 1, 5), 5);
  EXPECT_EQ(Rounds::most_rounds({1.1, 1.1}, 1, 5), 1);
}

TEST_F(RoundsTest, EndWhereSamplesTakeMinutesToPrepare) {
  EXPECT_EQ(Rounds::most_rounds({0.01, 29}, 1, 5), 5);
  EXPECT_EQ(Rounds::most_rounds({0.01, 31}, 1, 5), 1);
}

}  // namespace
}  // namespace terrabench::cross
