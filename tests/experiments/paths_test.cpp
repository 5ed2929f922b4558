// Camera paths of experiments on ground that is no square.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

class Paths : public CommandLine {
 protected:
  void write_ground(int width, int depth, bool voids = false) const {
    Heightfield ground = test::ground_of(
        width, depth, [](int i, int j) { return 60 * std::sin(0.3 * i) * std::cos(0.2 * j) + 80; }, 30, 30);
    // All but a corner.
    for (int j = 0; voids && j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        if (i + j > (width + depth) / 5) ground.at(i, j) = Heightfield::kNoData;
      }
    }
    write_geotiff(folder_ / "ground.tif", ground);
  }
  // Of one method.
  Outcome measure(const std::string& path) const {
    std::filesystem::remove_all(folder_ / "out");
    return call(fmt::format(
        "$T run cross.lod-seams --terrain ground.tif --shard 2/8 --set frames=4,path={} --out out", path));
  }
};

TEST_F(Paths, NamedPathsMeasureOnGroundOfAnyShape) {
  for (const auto& [width, depth] : {std::pair{129, 100}, {31, 91}, {91, 31}, {9, 161}}) {
    write_ground(width, depth);
    for (const char* const path : {"cross", "fly", "low", "turn", "walk"}) {
      const Outcome outcome = measure(path);
      EXPECT_EQ(outcome.code, 0) << path << " on " << width << " x " << depth << '\n' << outcome.text;
    }
  }
}

TEST_F(Paths, AnEyeStandsOverVoids) {
  write_ground(65, 65, true);
  for (const char* const path : {"cross", "fly"}) {
    const Outcome outcome = measure(path);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
  }
  const Outcome picture = call("$T render ground.tif --path walk --size 64x48 --out void.png");
  EXPECT_EQ(picture.code, 0) << picture.text;
}

TEST_F(Paths, APathThatSeesNothingIsRefused) {
  write_ground(65, 65);
  write_file(folder_ / "sky.toml",
             std::string_view("kind = \"fly\"\nfield_of_view = 40\nscreen = [64, 48]\nframes_per_second = 1\n"
                              "speed = 50\n[[keyframe]]\nat = [100, 300]\nheight = 100\nheading = 90\n"
                              "pitch = 60\n[[keyframe]]\nat = [400, 300]\nheight = 100\nheading = 90\n"
                              "pitch = 50\n"));
  const Outcome outcome = measure("sky.toml");
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.text, HasSubstr("no sample of ground.tif is visible in any metered frame"));
}

}  // namespace
}  // namespace terrabench
