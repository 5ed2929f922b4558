// A short flight over endless ground: the counts that the ledger's row reads.
#include <gtest/gtest.h>

#include <filesystem>

#include "results/store/store.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

class LodEndless : public CommandLine {
 protected:
  static std::vector<double> samples(const Record& record, std::string_view metric) {
    const Metric* const found = record.find(metric);
    return found == nullptr ? std::vector<double>{} : found->samples;
  }
};

TEST_F(LodEndless, FliesAndComesHome) {
  const Outcome outcome = call(
      "exec $T run cross.lod-endless --out out --set window=31 --set distance=40 --set step=500 "
      "--set far=20");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Store store = Store::open(folder_ / "out");
  ASSERT_EQ(store.records().size(), 2U);
  for (const Record& record : store.records()) {
    const auto only = [&](std::string_view metric) {
      const std::vector<double> all = samples(record, metric);
      return all.size() == 1 ? all[0] : -1;
    };
    EXPECT_EQ(only("edges_in_view"), 0);
    EXPECT_EQ(only("gaps"), 0);
    EXPECT_EQ(only("metered_frames"), 8);
    EXPECT_EQ(only("heights_differing"), 0);
    EXPECT_GT(only("heights_compared"), 31 * 31 * 4);
    EXPECT_GT(only("flight_bytes"), 0);
    EXPECT_EQ(only("flight_bytes"), only("flight_strip_bytes"));
    EXPECT_EQ(only("held_first"), only("held_home"));
    EXPECT_EQ(samples(record, "update_time").size(), 160U);
    ASSERT_EQ(record.figures.size(), 1U);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / record.figures[0].file));
  }
  EXPECT_NE(store.records()[0].figures[0].id, store.records()[1].figures[0].id);
}

TEST_F(LodEndless, TakesNoTerrain) {
  EXPECT_EQ(call("exec $T run cross.lod-endless --out out --terrain jacksboro").code, 2);
}

}  // namespace
}  // namespace terrabench
