#include "experiments/recorder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "terrain/error.h"

namespace terrabench {
namespace {

// Where a case draws the picture of one ledger row.
std::filesystem::path picture(const std::string& profile, const std::string& case_name,
                              std::vector<std::string> overrides = {}) {
  Record record;
  record.profile = profile;
  record.case_name = case_name;
  record.overrides = std::move(overrides);
  const std::filesystem::path path = Recorder(record, "out").figure("drill.F1", "channels").path;
  EXPECT_EQ(record.figures.size(), 1U);
  EXPECT_EQ(std::filesystem::path("out") / record.figures.front().file, path);
  EXPECT_EQ(record.figures.front().id, "drill.F1");
  return path;
}

TEST(Recorder, ProfilesAndChangedParametersDrawPicturesOfTheirOwn) {
  const std::set<std::filesystem::path> paths{picture("quick", "jacksboro"), picture("paper", "jacksboro"),
                                              picture("paper", "jacksboro (w=3)", {"w=3"}),
                                              picture("paper", "jacksboro (w=4)", {"w=4"})};
  EXPECT_EQ(paths.size(), 4U);
  for (const std::filesystem::path& path : paths) {
    EXPECT_EQ(path.parent_path(), "out/figures");
    EXPECT_EQ(path.extension(), ".webp");
  }
}

TEST(Recorder, SamplesOfOneMetricGatherInOrder) {
  Record record;
  Recorder recorder(record, "out");
  recorder.add("time", "s", 3);
  recorder.add("bytes", "B", 7);
  recorder.add("time", "s", 1);
  ASSERT_EQ(record.metrics.size(), 2U);
  EXPECT_EQ(record.metrics[0].samples, (std::vector<double>{3, 1}));
  EXPECT_EQ(record.metrics[1].unit, "B");
}

TEST(Recorder, WhatIsNotFiniteIsRefusedAndWhatIsNotDefinedHasAReason) {
  Record record;
  Recorder recorder(record, "out");
  EXPECT_THROW(recorder.add("error", "m", NAN), Error);
  EXPECT_THROW(recorder.add_varying("ratio", "", INFINITY), Error);
  EXPECT_TRUE(record.metrics.empty());
  recorder.add_ratio("of_relief", 3, 4, "the ground is flat");
  recorder.add_ratio("of_flat", 3, 0, "the ground is flat");
  EXPECT_EQ(record.find("of_relief")->samples, std::vector{0.75});
  EXPECT_EQ(record.find("of_flat"), nullptr);
  EXPECT_EQ(record.why_absent("of_flat")->reason, "the ground is flat");
}

}  // namespace
}  // namespace terrabench
