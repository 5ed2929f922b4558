// The trees of processor and GPU side by side.
#include <gtest/gtest.h>

#include "experiments/experiment.h"
#include "tests/experiments/value.h"

namespace terrabench {
namespace {

TEST(LodGpu, ComparesTheTreesAndTimesThem) {
  const Record record = measured("cross.lod-gpu", {{"size", std::int64_t{65}}, {"error", 0.5}}, "fractal");
  EXPECT_EQ(value(record, "splits_differing"), 0);
  EXPECT_EQ(value(record, "gpu_tree"), value(record, "paper_tree"));
  EXPECT_EQ(value(record, "processor_tree"), value(record, "paper_tree"));
  EXPECT_GT(value(record, "gpu_frames_to_rest"), 2);
  EXPECT_EQ(value(record, "gpu_frames_to_rest"), value(record, "processor_frames_to_rest"));
  for (const char* const by : {"processor_choose", "gpu_choose"}) {
    const Metric* const times = record.find(by);
    ASSERT_NE(times, nullptr);
    EXPECT_TRUE(times->series);
    EXPECT_EQ(times->samples.size(), record.find("leaves")->samples.size());
    EXPECT_GT(value(record, by), 0);
  }
  EXPECT_GT(value(record, "leaves"), 100);
}

}  // namespace
}  // namespace terrabench
