// The walk over ground on disk: its counts, and that no temporary files remain after success, errors and
// interruptions.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "results/store/store.h"
#include "terrain/heightfield.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/height_pyramid.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

class LodDisk : public CommandLine {
 protected:
  void SetUp() override { fs::create_directories(temporary_); }
  std::string run(const std::string& rest) const {
    return "TMPDIR=" + temporary_.string() + " exec $T run cross.lod-disk --out out " + rest;
  }
  double only(const Record& record, std::string_view metric) const {
    const Metric* const found = record.find(metric);
    return found != nullptr && found->samples.size() == 1 ? found->samples[0] : -1;
  }
  const fs::path temporary_ = folder_ / "temporary";
};

TEST_F(LodDisk, UploadsTheStripsAndLeavesNothing) {
  const Outcome outcome = call(run("--set side=700 --set steps=40 --set window=63"));
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Store store = Store::open(folder_ / "out");
  ASSERT_EQ(store.records().size(), 1U);
  const Record& record = store.records().front();
  for (const char* const part : {"step", "walk"}) {
    const double bytes = only(record, std::string(part) + "_bytes");
    EXPECT_GT(bytes, 0);
    EXPECT_EQ(bytes, only(record, std::string(part) + "_strip_bytes"));
  }
  EXPECT_EQ(record.find("step_time")->samples.size(), 40U);
  EXPECT_EQ(only(record, "ground_bytes"), 4 * 700 * 700);
  EXPECT_GT(only(record, "peak_resident"), only(record, "clipmap_bytes"));
  EXPECT_TRUE(fs::is_empty(temporary_));
}

// On ground shorter than the number of steps, the walk turns back at the border.
TEST_F(LodDisk, KeepsWalkingOverShortGround) {
  const Outcome outcome = call(run("--set side=40 --set steps=400 --set window=15"));
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Store store = Store::open(folder_ / "out");
  const double bytes = only(store.records().front(), "step_bytes");
  // The finest window alone uploads two columns of 15 samples every other step.
  EXPECT_GE(bytes, 150.0 * 2 * 15 * 4);
  EXPECT_EQ(bytes, only(store.records().front(), "step_strip_bytes"));
}

TEST_F(LodDisk, APyramidIsKnownByItsContent) {
  Heightfield field;
  field.width = 60;
  field.depth = 50;
  field.heights.assign(std::size_t{60} * 50, 5);
  Progress silent;
  for (const char* const name : {"one", "same", "other"}) {
    field.at(30, 20) = name == std::string_view("other") ? 6.0F : 5.0F;
    write_geotiff(folder_ / "ground.tif", field);
    HeightPyramid::build((folder_ / "ground.tif").string(), folder_ / name, silent);
    const Outcome outcome = call(run(std::string("--set steps=3 --terrain ") + name));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
  }
  const Store store = Store::open(folder_ / "out");
  std::map<std::string, std::string> digests;
  for (const Record& record : store.records()) digests[record.terrain] = record.terrain_checksum;
  ASSERT_EQ(digests.size(), 3U);
  EXPECT_EQ(digests["one"].size(), 32U);
  EXPECT_EQ(digests["one"], digests["same"]);
  EXPECT_NE(digests["one"], digests["other"]);
}

TEST_F(LodDisk, WalksOverFilesAndRefusesWhatHasNoHeights) {
  Heightfield field;
  field.width = 90;
  field.depth = 70;
  field.heights.assign(std::size_t{90} * 70, 5);
  field.at(3, 3) = Heightfield::kNoData;
  write_geotiff(folder_ / "holes.tif", field);
  const Outcome outcome = call(run("--terrain holes.tif --set steps=5"));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const char* const bad : {"caves", "temporary"}) {  // a solid; a folder that holds no pyramid
    const Outcome refused = call(run(std::string("--terrain ") + bad));
    EXPECT_EQ(refused.code, 5) << bad;
    EXPECT_THAT(refused.text, testing::HasSubstr("failed (1 case): "));
  }
  EXPECT_TRUE(fs::is_empty(temporary_));
}

// Once while the ground is made, once while the clipmap walks.
TEST_F(LodDisk, AnInterruptionLeavesNothing) {
  for (const auto& [rest, sign] : {std::pair{"--set side=16384", "ground.tif"},
                                   std::pair{"--set side=300 --set steps=1000000", "pyramid"}}) {
    const pid_t child = start(run(rest));
    const auto walking = [&, file = sign] {
      const fs::directory_iterator all(temporary_);
      return std::any_of(begin(all), end(all),
                         [&](const auto& entry) { return fs::exists(entry.path() / file); });
    };
    for (int k = 0; k < 600 && !walking(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(fs::is_empty(temporary_)) << rest;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(child, SIGINT);
    const Outcome outcome = wait(child);
    EXPECT_EQ(outcome.code, 130) << outcome.text;
    EXPECT_TRUE(fs::is_empty(temporary_)) << rest;
  }
}

}  // namespace
}  // namespace terrabench
