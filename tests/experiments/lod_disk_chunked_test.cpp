// The flight over chunks on disk: what it records, and that no temporary files remain.
#include <gmock/gmock.h>

#include "results/store/store.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

class LodDiskChunked : public CommandLine {};

TEST_F(LodDiskChunked, FliesWithinItsBudgetAndLeavesNothing) {
  const fs::path temporary = folder_ / "temporary";
  fs::create_directories(temporary);
  const Outcome outcome =
      call("TMPDIR=" + temporary.string() +
           " exec $T run cross.lod-disk-chunked --out out --set side=700 --set seconds=1 --set budget=8");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Store store = Store::open(folder_ / "out");
  ASSERT_EQ(store.records().size(), 1U);
  const auto only = [&](std::string_view metric) {
    const Metric* const found = store.records().front().find(metric);
    return found != nullptr && found->samples.size() == 1 ? found->samples[0] : -1;
  };
  EXPECT_EQ(store.records().front().find("update_time")->samples.size(), 60U);
  EXPECT_GT(only("longest_time"), 0);
  EXPECT_GE(only("longest_time"), only("p99_time"));
  EXPECT_GE(only("late_frames"), 0);
  EXPECT_GT(only("file_bytes"), 2 * 700 * 700);
  EXPECT_GT(only("held_bytes"), 100000);
  EXPECT_LT(only("held_bytes"), 9 << 20);  // the budget, entries and lists
  EXPECT_GT(only("peak_resident"), only("held_bytes"));
  EXPECT_TRUE(fs::is_empty(temporary));
}

}  // namespace
}  // namespace terrabench
