// The files that cross.file-size compares, checked from outside: their size on disk, and what GDAL reads of
// them.
#include "experiments/cross/files/file_search.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "experiments/cross/files/temporary_folder.h"
#include "representations/export/export.h"
#include "representations/line_grid.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench::cross {
namespace {

const Scene& ground(Progress& progress) { return scene({.terrain = "fractal", .size = 65}, progress); }

std::vector<BuiltFile> search(std::string_view type, int builds = 24) {
  Progress silent;
  const Scene& on = ground(silent);
  const std::array aims{FileAim{FileAim::kError, &BuiltFile::largest, 0.01 * relief_of(on)},
                        FileAim{FileAim::kBytes, &BuiltFile::rmse, 0.1 * own_bytes(on)}};
  return search_files(on, representation(type), builds, aims, silent);
}

// The largest error and the RMSE at every sample, from a GeoTIFF that GDAL reads.
std::pair<double, double> errors_by_gdal(const Representation& read, const Heightfield& source,
                                         const RepresentationType& type) {
  Progress silent;
  const TemporaryFolder folder;
  const std::filesystem::path raster = folder.path() / "read.tif";
  export_representation(raster, type, read, lines_of(source), silent);
  const Heightfield heights = read_dem(raster).heights;
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < source.heights.size(); ++i) {
    const double error = std::abs(static_cast<double>(heights.heights[i]) - source.heights[i]);
    largest = std::max(largest, error);
    sum += error * error;
  }
  return {largest, std::sqrt(sum / static_cast<double>(source.heights.size()))};
}

TEST(FileSearch, ThreePointsOfThreeCurvesAreWhatTheFilesHold) {
  Progress silent;
  const Scene& on = ground(silent);
  for (const char* const name : {"heightmap", "tin", "layered_stack"}) {
    const RepresentationType& type = representation(name);
    const std::vector<BuiltFile> best = best_files(search(name), &BuiltFile::largest);
    ASSERT_GE(best.size(), 6U) << name;
    for (const std::size_t k : {std::size_t{0}, best.size() / 2, best.size() - 1}) {
      const TemporaryFolder folder;
      const std::filesystem::path path = folder.path() / "again.tb";
      save_representation(path, type, *type.build(on.source, best[k].parameters, silent), best[k].within);
      EXPECT_EQ(std::filesystem::file_size(path), best[k].bytes) << name;
      const auto [largest, rmse] =
          errors_by_gdal(*load_representation(path).representation, *on.source.heights, type);
      EXPECT_NEAR(largest, best[k].largest, 1e-3) << name;
      EXPECT_NEAR(rmse, best[k].rmse, 1e-3) << name;
    }
  }
}

TEST(FileSearch, LargerFilesAmongTheBestAreCloser) {
  const std::vector<BuiltFile> best = best_files(search("heightmap"), &BuiltFile::rmse);
  ASSERT_GE(best.size(), 3U);
  for (std::size_t k = 1; k < best.size(); ++k) {
    EXPECT_GT(best[k].bytes, best[k - 1].bytes);
    EXPECT_LT(best[k].rmse, best[k - 1].rmse);
  }
  EXPECT_EQ(smallest_within(best, &BuiltFile::rmse, best[1].rmse)->bytes, best[1].bytes);
  EXPECT_EQ(closest_within(best, &BuiltFile::rmse, static_cast<double>(best[1].bytes))->rmse, best[1].rmse);
  EXPECT_EQ(closest_within(best, &BuiltFile::rmse, 1), nullptr);
}

TEST(FileSearch, MakesTheSameFilesWithAnyNumberOfThreads) {
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return search("drill", 16);
  };
  const std::vector<BuiltFile> once = with_threads(1), again = with_threads(2);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].bytes, again[k].bytes);
    EXPECT_EQ(once[k].rmse, again[k].rmse);
  }
}

// The search aims at an error of 1 % of the relief: heights must come within a tenth of it, not stay far
// below. Likewise at a tenth of the ground's own bytes.
TEST(FileSearch, ComesNearToWhatItAimsAt) {
  Progress silent;
  const Scene& on = ground(silent);
  const double error = 0.01 * relief_of(on), bytes = 0.1 * own_bytes(on);
  const std::vector<BuiltFile> files = search("heightmap", 40);
  const BuiltFile* const small = smallest_within(files, &BuiltFile::largest, error);
  ASSERT_NE(small, nullptr);
  EXPECT_GT(small->largest, 0.9 * error);
  const BuiltFile* const close = closest_within(files, &BuiltFile::rmse, bytes);
  ASSERT_NE(close, nullptr);
  EXPECT_GT(static_cast<double>(close->bytes), 0.9 * bytes);
}

}  // namespace
}  // namespace terrabench::cross
