#include "experiments/cross/rounds.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace terrabench::cross {
namespace {

TEST(Rounds, DoEachPieceOnceARound) {
  std::string order;
  Rounds rounds(1e9);
  rounds.time("a", [&] { order += 'a'; });
  rounds.sample({"b", "c"}, "1/s", [&] {
    order += 'b';
    return std::vector{static_cast<double>(order.size()), 1.0};
  });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(order, "ababababababababab");
  EXPECT_EQ(record.find("a")->unit, "s");
  EXPECT_EQ(record.find("a")->samples.size(), std::size_t{Rounds::kMost});
  EXPECT_EQ(record.find("b")->unit, "1/s");
  EXPECT_EQ(record.find("c")->samples, std::vector<double>(Rounds::kMost, 1));
  EXPECT_EQ(record.find("b")->samples, (std::vector<double>{2, 4, 6, 8, 10, 12, 14, 16, 18}));
}

TEST(Rounds, DoLongWorkOnce) {
  std::string order;
  Rounds rounds(0);
  rounds.time("a", [&] { order += 'a'; });
  rounds.time("b", [&] { order += 'b'; });
  Record record;
  Recorder recorder(record, "");
  rounds.run(recorder);
  EXPECT_EQ(order, "ab");
}

TEST(Rounds, TakeFewSamplesOfShortWorkThatIsLongToPrepare) {
  std::string order;
  Rounds rounds(0.05, 2);
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

TEST(Rounds, TakeFewSamplesOfWorkThatAddsUp) {
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.0}, 1), Rounds::kMost);
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.2}, 1), Rounds::kFew);
  EXPECT_EQ(Rounds::most_rounds({1.1, 1.1}, 1), 1);
  EXPECT_EQ(Rounds::most_rounds({0.4, 1.2}, 1, 5), 5);
  EXPECT_EQ(Rounds::most_rounds({1.1, 1.1}, 1, 5), 1);
}

TEST(Rounds, EndWhereSamplesTakeMinutesToPrepare) {
  EXPECT_EQ(Rounds::most_rounds({0.01, 29}, 1, 5), 5);
  EXPECT_EQ(Rounds::most_rounds({0.01, 31}, 1, 5), 1);
}

}  // namespace
}  // namespace terrabench::cross
