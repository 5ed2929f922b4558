// Heights written band by band are equal when read.
#include "terrain/sources/dem/geotiff_rows.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

const fs::path& file() {
  static const fs::path path =
      fs::temp_directory_path() / ("terrabench_rows_" + std::to_string(getpid()) + ".tif");
  return path;
}

TEST(GeotiffRows, BandsOfAnySizeMakeTheGround) {
  constexpr int kWidth = 300, kDepth = 611;
  std::vector<float> heights;
  for (int k = 0; k < kWidth * kDepth; ++k) heights.push_back(std::sin(static_cast<float>(k)) * 1e3F);
  GeotiffRows rows(file(), kWidth, kDepth, 2.5F, 7);
  for (int first = 0, band = 1; first < kDepth; first += band, band = 2 * band + 1) {
    const int count = std::min(band, kDepth - first);
    rows.write(
        {&heights[static_cast<std::size_t>(first) * kWidth], static_cast<std::size_t>(count) * kWidth});
  }
  rows.close();
  const Heightfield read = read_dem(file().string()).heights;
  fs::remove(file());
  EXPECT_EQ(read.width, kWidth);
  EXPECT_EQ(read.depth, kDepth);
  EXPECT_EQ(read.cell_x, 2.5F);
  EXPECT_EQ(read.cell_z, 7);
  EXPECT_EQ(read.heights, heights);
}

TEST(GeotiffRows, SaysThatItCannotWrite) {
  EXPECT_EQ(failure_of([] { GeotiffRows("/nowhere/at/all.tif", 10, 10, 1, 1); }).code,
            ExitCode::kEnvironment);
}

}  // namespace
}  // namespace terrabench
