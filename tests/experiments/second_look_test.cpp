#include "experiments/second_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/store.h"
#include "terrain/error.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Record record(std::vector<Metric> metrics) {
  Record made;
  made.experiment = "ght.edits";
  made.case_name = "n=64";
  made.metrics = std::move(metrics);
  return made;
}

std::string refusal(const Record& first, const Record& again) {
  try {
    with_second_look(first, again);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kEnvironment);
    return error.what();
  }
  return "";
}

TEST(SecondLook, AddsTheSamplesOfWhatVaries) {
  const Record both = with_second_look(
      record({{"time", "s", {3, 1}}, {"bytes", "B", {7}}, {"ratio", "", {2}, true}}),
      record({{"bytes", "B", {7}}, {"time", "s", {2, 4}}, {"ratio", "", {5}, true}, {"late", "s", {9}}}));
  EXPECT_THAT(both.find("time")->samples, ElementsAre(3, 1, 2, 4));
  EXPECT_THAT(both.find("ratio")->samples, ElementsAre(2, 5));
  EXPECT_THAT(both.find("bytes")->samples, ElementsAre(7));
  EXPECT_THAT(both.find("late")->samples, ElementsAre(9)) << "a size that only the second look reached";
}

TEST(SecondLook, RefusesExactFiguresThatDiffer) {
  const Record first = record({{"bytes", "B", {7}}});
  EXPECT_EQ(refusal(first, first), "");
  EXPECT_THAT(refusal(first, record({{"bytes", "B", {8}}})), HasSubstr("'bytes': 7, then 8"));
  EXPECT_THAT(refusal(first, record({{"bytes", "m", {7}}})), HasSubstr("'bytes'"));
  EXPECT_THAT(refusal(first, record({})), HasSubstr("'bytes': 7, then nothing"));
  EXPECT_THAT(refusal(record({}), first), HasSubstr("'bytes': nothing, then 7"));
  Record drawn = first;
  drawn.figures.push_back({"ght.F1", "figures/ght.F1.quick.png", "a picture", "0123"});
  EXPECT_THAT(refusal(first, drawn), HasSubstr("pictures"));
  EXPECT_EQ(refusal(drawn, drawn), "");
}

// The samples of the newest record of hybrid.table2.
std::size_t samples(const std::filesystem::path& folder) {
  const Store store = Store::open(folder);
  return store.records().back().find("generation_time")->samples.size();
}

TEST_F(CommandLine, ShortTimedCasesAreMeasuredTwiceInOneRun) {
  const std::string run = "$T run hybrid.table2 --set n=16 ";
  ASSERT_EQ(call(run + "--again 0 --out once").code, 0);
  const Outcome twice = call(run + "--again 1000 --out twice");
  ASSERT_EQ(twice.code, 0) << twice.text;
  EXPECT_EQ(samples(folder_ / "twice"), 2 * samples(folder_ / "once"));
  EXPECT_THAT(twice.text, HasSubstr("again: "));
  EXPECT_EQ(Store::open(folder_ / "twice").records().size(), Store::open(folder_ / "once").records().size());
  EXPECT_EQ(call("$T compare once twice").code, 0);
  EXPECT_EQ(call(run + "--again -1 --out twice").code, 2);
}

}  // namespace
}  // namespace terrabench
