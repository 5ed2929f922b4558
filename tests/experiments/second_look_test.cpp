#include "experiments/second_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/interference.h"
#include "results/store/store.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Record record(std::vector<Metric> metrics) {
  Record made;
  made.experiment = "ght.edits";
  made.case_name = "n=64";
  made.metrics = std::move(metrics);
  return made;
}

// Of the looks below, those beside a loop of 1 s are disturbed, and those beside one of 0 s are not.
TEST(SecondLook, AddsTheSamplesOfWhatVaries) {
  loop_seconds();
  const Record first = record({{"time", "s", {3, 1}}, {"bytes", "B", {7}}, {"ratio", "", {2}, true}});
  const Record second = record({{"bytes", "B", {7}}, {"time", "s", {2, 4}}, {"ratio", "", {5}, true}});
  EXPECT_EQ(with_second_look({first, 1}, {second, 1}).find("time")->samples,
            with_second_look({first}, {second}).find("time")->samples);
  const Record both = with_second_look({first}, {second});
  EXPECT_THAT(both.find("time")->samples, ElementsAre(3, 1, 2, 4));
  EXPECT_EQ(both.find("time")->first_look, 2U);
  EXPECT_EQ(both.find("ratio")->first_look, 1U);
  EXPECT_EQ(both.find("bytes")->first_look, 0U);
  EXPECT_THAT(both.find("ratio")->samples, ElementsAre(2, 5));
  EXPECT_THAT(both.find("bytes")->samples, ElementsAre(7));
}

TEST(SecondLook, KeepsTheUndisturbedOneAlone) {
  loop_seconds();
  const Record calm = record({{"time", "s", {3, 1}}, {"bytes", "B", {7}}}),
               slow = record({{"time", "s", {5, 4}}, {"bytes", "B", {7}}});
  for (const Record& kept :
       {with_second_look({calm, 0}, {slow, 1}), with_second_look({slow, 1}, {calm, 0})}) {
    EXPECT_THAT(kept.find("time")->samples, ElementsAre(3, 1));
    EXPECT_EQ(kept.find("time")->first_look, 0U);
    EXPECT_THAT(kept.find("bytes")->samples, ElementsAre(7));
  }
}

TEST(SecondLook, FindsExactFiguresThatDiffer) {
  const Record first = record({{"time", "s", {3}}, {"bytes", "B", {7}}});
  EXPECT_EQ(exact_difference(first, first), "");
  EXPECT_EQ(exact_difference(first, record({{"time", "s", {4}}, {"bytes", "B", {7}}})), "");
  EXPECT_EQ(exact_difference(first, record({{"time", "s", {3}}, {"bytes", "B", {8}}})),
            "the metric 'bytes': 7 B, then 8 B");
  EXPECT_EQ(exact_difference(first, record({{"time", "s", {3}}, {"bytes", "m", {7}}})),
            "the metric 'bytes': 7 B, then 7 m");
  const Record more = record({{"time", "s", {3}}, {"bytes", "B", {7}}, {"late", "s", {9}}});
  EXPECT_EQ(exact_difference(first, more), "the new metric 'late'");
  EXPECT_EQ(exact_difference(more, first), "the lost metric 'late'");
  Record drawn = first;
  drawn.figures.push_back({"ght.F1", "figures/ght.F1.quick.png", "a picture", "0123"});
  EXPECT_EQ(exact_difference(first, drawn), "the pictures");
  EXPECT_EQ(exact_difference(drawn, drawn), "");
}

// Of the newest record of hybrid.table2.
Metric generation_time(const std::filesystem::path& folder) {
  return *Store::open(folder).records().back().find("generation_time");
}

TEST_F(CommandLine, ShortTimedCasesAreMeasuredTwiceInOneRun) {
  const std::string run = "$T run hybrid.table2 --set n=16 ";
  ASSERT_EQ(call(run + "--again 0 --out once").code, 0);
  const Outcome twice = call(run + "--again 1000 --out twice");
  ASSERT_EQ(twice.code, 0) << twice.text;
  // The newest record is of the last case measured again.
  const bool disturbed =
      twice.text.find("one of the two disturbed", twice.text.rfind(", again: ")) != std::string::npos;
  const Metric first = generation_time(folder_ / "once"), both = generation_time(folder_ / "twice");
  EXPECT_EQ(both.samples.size(), (disturbed ? 1 : 2) * first.samples.size());
  EXPECT_EQ(first.first_look, 0U);
  EXPECT_EQ(both.first_look, disturbed ? 0U : first.samples.size());
  EXPECT_THAT(twice.text, HasSubstr("again: "));
  EXPECT_EQ(Store::open(folder_ / "twice").records().size(), Store::open(folder_ / "once").records().size());
  EXPECT_EQ(call("$T compare once twice").code, 0);
  EXPECT_THAT(call("$T run hybrid.fresnel --again 1000 --out untimed").text, Not(HasSubstr("again: ")));
  // A case of a timed experiment that reaches no error, and so records no time.
  const Outcome unreached = call(
      "$T run cross.representations --shard 1/1000 --set representation=implicit,error=1e-9 --again 1000 "
      "--out unreached");
  ASSERT_EQ(unreached.code, 0) << unreached.text;
  EXPECT_THAT(unreached.text, AllOf(HasSubstr("[1/1] "), Not(HasSubstr("again: "))));
  const Outcome fresh =
      call("$T run cross.scale --shard 1/5 --set largest=513,seconds=0.01 --again 1000 --out fresh");
  ASSERT_EQ(fresh.code, 0) << fresh.text;
  EXPECT_THAT(fresh.text, AllOf(HasSubstr("[4/4] "), Not(HasSubstr("again: "))));
  EXPECT_EQ(call(run + "--again -1 --out twice").code, 2);
}

}  // namespace
}  // namespace terrabench
