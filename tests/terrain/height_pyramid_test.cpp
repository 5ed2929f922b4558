// Windows of every level are the ground's own samples, repeated at its borders; what is damaged says so.
#include "terrain/sources/dem/height_pyramid.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "terrain/error.h"
#include "terrain/sources/dem/dem.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

class HeightPyramidTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("terrabench_pyramid_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Heightfield ground(int width, int depth) {
    return test::random_ground(width, depth, 5, 0, 1000, 2, 3);
  }
  fs::path built(const Heightfield& field) {
    write_geotiff(folder_ / "dem.tif", field);
    Progress silent;
    HeightPyramid::build((folder_ / "dem.tif").string(), folder_ / "pyramid", silent);
    return folder_ / "pyramid";
  }
  fs::path folder_;
};

TEST_F(HeightPyramidTest, GivesEveryLevelsOwnSamples) {
  for (const auto& [width, depth] :
       {std::pair{300, 517}, {256, 256}, {1, 1}, {2, 700}, {512, 512}, {9, 1024}}) {
    const Heightfield field = ground(width, depth);
    const auto pyramid = HeightPyramid::open(built(field));
    EXPECT_EQ(pyramid->width(), width);
    EXPECT_EQ(pyramid->depth(), depth);
    std::mt19937 random(9);
    for (int k = 0; k < 60; ++k) {
      const int level = static_cast<int>(random() % 13);
      const int a = static_cast<int>(random() % 800) - 250, b = static_cast<int>(random() % 1400) - 250;
      const int columns = 1 + static_cast<int>(random() % 70), rows = 1 + static_cast<int>(random() % 70);
      std::vector<float> out(static_cast<std::size_t>(80) * rows, -1);
      pyramid->read(level, a, b, columns, rows, out.data(), 80);
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
          const int x =
              static_cast<int>(std::clamp<std::int64_t>(std::int64_t{a + i} << level, 0, width - 1));
          const int z =
              static_cast<int>(std::clamp<std::int64_t>(std::int64_t{b + j} << level, 0, depth - 1));
          ASSERT_EQ(out[static_cast<std::size_t>(80) * j + i], field.at(x, z))
              << level << ' ' << a << ' ' << b;
        }
      }
    }
  }
}

TEST_F(HeightPyramidTest, CountsTheTilesItDecodes) {
  const auto pyramid = HeightPyramid::open(built(ground(600, 600)));
  std::vector<float> out(std::size_t{600} * 600);
  EXPECT_EQ(pyramid->tiles_read(), 0U);
  pyramid->read(0, 250, 10, 10, 10, out.data(), 10);  // across two of 3 × 3
  EXPECT_EQ(pyramid->tiles_read(), 2U);
  pyramid->read(0, 200, 0, 100, 100, out.data(), 100);  // the same, which the cache holds
  EXPECT_EQ(pyramid->tiles_read(), 2U);
  pyramid->read(0, 0, 0, 600, 600, out.data(), 600);
  EXPECT_EQ(pyramid->tiles_read(), 9U);
}

TEST_F(HeightPyramidTest, FillsHoles) {
  Heightfield field = ground(90, 80);
  for (int k = 0; k < 30; ++k) field.at(40 + k % 6, 30 + k / 6) = Heightfield::kNoData;
  const auto pyramid = HeightPyramid::open(built(field));
  float hole = -1;
  pyramid->read(0, 42, 32, 1, 1, &hole, 1);
  EXPECT_GE(hole, 0);
  EXPECT_LE(hole, 1000);
}

TEST_F(HeightPyramidTest, RefusesWhatIsNotWhole) {
  const fs::path pyramid = built(ground(300, 200));
  EXPECT_THROW(HeightPyramid::open(folder_), Error);
  EXPECT_THROW(HeightPyramid::open(folder_ / "nothing"), Error);
  fs::rename(pyramid / "2.tif", pyramid / "kept");
  EXPECT_THROW(HeightPyramid::open(pyramid), Error);
  fs::copy_file(pyramid / "1.tif", pyramid / "2.tif");
  EXPECT_THROW(HeightPyramid::open(pyramid), Error);
  fs::rename(pyramid / "kept", pyramid / "2.tif");
  EXPECT_NO_THROW(HeightPyramid::open(pyramid));
  fs::resize_file(pyramid / "0.tif", fs::file_size(pyramid / "0.tif") / 2);
  const auto read_all = [&] {
    const auto cut = HeightPyramid::open(pyramid);
    std::vector<float> out(std::size_t{300} * 200);
    cut->read(0, 0, 0, 300, 200, out.data(), 300);
  };
  EXPECT_THROW(read_all(), Error);
}

TEST_F(HeightPyramidTest, ReplacesOnlyPyramidsAndLeavesNothingHalf) {
  const Heightfield field = ground(40, 40);
  built(field);
  const fs::path pyramid = built(field);  // again, in place
  // Not where something else would be lost.
  std::ofstream(pyramid / "notes.txt") << "years of work";
  EXPECT_THROW(built(field), Error);
  EXPECT_TRUE(fs::exists(pyramid / "notes.txt"));
  fs::remove(pyramid / "notes.txt");
  EXPECT_NO_THROW(built(field));
  Progress silent;
  fs::create_directories(folder_ / "mine");
  EXPECT_THROW(HeightPyramid::build((folder_ / "dem.tif").string(), folder_ / "mine", silent), Error);
  EXPECT_TRUE(fs::exists(folder_ / "mine"));
  // A level alone, as another program may name its tiles, is no pyramid.
  fs::copy_file(pyramid / "0.tif", folder_ / "mine/0.tif");
  EXPECT_THROW(HeightPyramid::build((folder_ / "dem.tif").string(), folder_ / "mine", silent), Error);
  EXPECT_TRUE(fs::exists(folder_ / "mine/0.tif"));
  EXPECT_THROW(HeightPyramid::build((folder_ / "absent.tif").string(), folder_ / "new", silent), Error);
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3);
}

}  // namespace
}  // namespace terrabench
