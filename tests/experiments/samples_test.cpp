#include "experiments/samples.h"

#include <gtest/gtest.h>

namespace terrabench {
namespace {

TEST(Samples, AreTakenInTurn) {
  std::string order;
  Samples samples;
  samples.time("a", [&] { order += 'a'; });
  samples.add({"b", "c"}, "1/s", [&] {
    order += 'b';
    return std::vector{static_cast<double>(order.size()), 1.0};
  });
  Record record;
  Recorder recorder(record, "");
  samples.take(recorder);
  EXPECT_EQ(order, "abababababab");
  EXPECT_EQ(record.find("a")->unit, "s");
  EXPECT_EQ(record.find("a")->samples.size(), 6U);
  EXPECT_EQ(record.find("b")->unit, "1/s");
  EXPECT_EQ(record.find("b")->samples, (std::vector<double>{2, 4, 6, 8, 10, 12}));
  EXPECT_EQ(record.find("c")->samples, std::vector<double>(6, 1));
  samples.take(recorder);
  EXPECT_EQ(order.size(), 12U) << "the work was forgotten";
}

TEST(Samples, AreSixOrOneOfLongWork) {
  const auto taken = [](Repetitions repetitions, double seconds_per_call) {
    int calls = 0;
    for (; repetitions.more(); ++calls) repetitions.add(seconds_per_call);
    return calls;
  };
  EXPECT_EQ(taken(Repetitions(), 0), 6);
  EXPECT_EQ(taken(Repetitions(), 10), 6);
  EXPECT_EQ(taken(Repetitions(), 11), 1);
  EXPECT_EQ(taken(Repetitions(0.5), 0.6), 1);
}

}  // namespace
}  // namespace terrabench
