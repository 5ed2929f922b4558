// The DEM reader on good files: types, layouts, values, units and formats; placement: dem_placement_test.cpp.
#include "terrain/sources/dem/dem.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "terrain/files.h"
#include "terrain/memory.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

TEST(Dem, ReadsAGeoTiffInMetres) {
  const TemporaryFolder folder;
  metres().write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  expect_ramp(dem.heights, 6, 4);
  EXPECT_EQ(dem.format, "GTiff");
  EXPECT_EQ(dem.heights.cell_x, 30);
  EXPECT_EQ(dem.heights.cell_z, 30);
  EXPECT_EQ(dem.heights.georeference.transform, kUtm);
  EXPECT_THAT(dem.heights.georeference.crs, HasSubstr("UTM zone 33N"));
  EXPECT_TRUE(dem.notes.empty()) << dem.notes[0];
  EXPECT_THAT(folder.names(), testing::ElementsAre("a.tif")) << "reading left a file behind";
}

TEST(Dem, ReadsEveryNumericType) {
  const TemporaryFolder folder;
  for (const GDALDataType type : {GDT_Byte, GDT_Int16, GDT_UInt16, GDT_Int32, GDT_UInt32, GDT_Int64,
                                  GDT_UInt64, GDT_Float32, GDT_Float64}) {
    RasterFile file = metres();
    file.type = type;
    file.no_data = 111;
    file.write(folder / "a.tif");
    const Heightfield field = read_dem(folder / "a.tif").heights;
    EXPECT_EQ(field.at(5, 3), 135.0F) << GDALGetDataTypeName(type);
    EXPECT_TRUE(std::isnan(field.at(1, 1))) << GDALGetDataTypeName(type);
    EXPECT_EQ(height_range(field).no_data, 1U) << GDALGetDataTypeName(type);
  }
}

TEST(Dem, ReadsTilesStripsAndWindowsAlike) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = 301;
  file.depth = 203;
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=32"},
                                             {"BLOCKYSIZE=1"},
                                             {"BLOCKYSIZE=203"},
                                             {"COMPRESS=LZW"}}) {
    file.options = options;
    file.write(folder / "a.tif");
    const Heightfield whole = read_dem(folder / "a.tif").heights;
    expect_ramp(whole, 301, 203);
    DemOptions window;
    window.window = {37, 45, 200, 150};
    const Heightfield part = read_dem(folder / "a.tif", window).heights;
    const Heightfield expected = crop(whole, 37, 45, 200, 150);
    EXPECT_EQ(part.heights, expected.heights);
    EXPECT_EQ(part.georeference, expected.georeference);
  }
}

TEST(Dem, ReductionWhileReadingEqualsResamplingAfterwards) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = 211;
  file.depth = 173;
  file.no_data = -1;
  file.value = [](int i, int j) { return (i * 7 + j * 13) % 11 == 0 ? -1 : (i * 31 + j * 17) % 997; };
  file.write(folder / "a.tif");
  const Heightfield whole = read_dem(folder / "a.tif").heights;
  for (const auto& [width, depth] :
       {std::pair{100, 50}, {211, 80}, {1, 1}, {300, 400}, {100, 300}, {211, 173}}) {
    DemOptions options;
    options.width = width;
    options.depth = depth;
    const Heightfield read = read_dem(folder / "a.tif", options).heights;
    const Heightfield expected = resample(whole, width, depth);
    EXPECT_EQ(checksum(read), checksum(expected)) << width << "×" << depth;
    EXPECT_EQ(read.georeference, expected.georeference);
  }
}

TEST(Dem, NoDataMaskAndImpossibleHeightsBecomeHoles) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.no_data = -3.4028234663852886e+38;
  file.value = [](int i, int j) {
    if (j > 0) return 5.0;
    const double kStrange[] = {-3.4028234663852886e+38, NAN, INFINITY, -INFINITY, 1e20, 7};
    return kStrange[i];
  };
  file.masked = [](int i, int j) { return j == 3 && i < 2; };
  file.write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  EXPECT_EQ(height_range(dem.heights).no_data, 7U);
  EXPECT_EQ(height_range(dem.heights).highest, 7);
  EXPECT_THAT(dem.notes, Contains("3 of 24 samples hold no height"));
  EXPECT_THAT(dem.notes, Contains(HasSubstr("4 heights are NaN, infinite")));
}

TEST(Dem, DeclaredNanIsOrdinaryNoData) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.no_data = NAN;
  file.value = [](int i, int) { return i == 2 ? NAN : 5.0; };
  file.write(folder / "a.tif");
  const Dem dem = read_dem(folder / "a.tif");
  EXPECT_EQ(height_range(dem.heights).no_data, 4U);
  EXPECT_THAT(dem.notes, testing::ElementsAre("4 of 24 samples hold no height"));
}

TEST(Dem, FillsHolesOnRequest) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.no_data = -9999;
  file.value = [](int i, int j) { return i == 2 && j == 2 ? -9999 : 50; };
  file.write(folder / "a.tif");
  DemOptions options;
  options.fill_no_data = true;
  const Dem dem = read_dem(folder / "a.tif", options);
  EXPECT_THAT(dem.heights.heights, Each(50.0F));
  EXPECT_THAT(dem.notes, Contains(HasSubstr("1 samples without height were filled")));
}

TEST(Dem, ConvertsHeightUnitsScaleAndOffset) {
  const TemporaryFolder folder;
  struct Case {
    const char* unit;
    double metres;
  };
  for (const Case& c :
       {Case{"ft", 0.3048}, {"US survey foot", 1200.0 / 3937}, {"cm", 0.01}, {"Metre", 1}, {"", 1}}) {
    RasterFile file = metres();
    file.unit = c.unit;
    file.scale = 0.5;
    file.offset = -20;
    file.write(folder / "a.tif");
    const Dem dem = read_dem(folder / "a.tif");
    EXPECT_FLOAT_EQ(dem.heights.at(4, 2), static_cast<float>((124 * 0.5 - 20) * c.metres)) << c.unit;
    EXPECT_EQ(dem.notes.size(), c.metres == 1 ? 1U : 2U) << c.unit;
  }
  RasterFile file = metres();
  file.unit = "kelvin";
  file.write(folder / "a.tif");
  EXPECT_THAT(read_dem(folder / "a.tif").notes, Contains(HasSubstr("no known unit of length")));
}

TEST(Dem, ReadsAnotherBand) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.bands = 3;
  file.write(folder / "a.tif");
  DemOptions options;
  options.band = 3;
  const Dem dem = read_dem(folder / "a.tif", options);
  EXPECT_EQ(dem.heights.at(0, 0), 2100.0F);
  EXPECT_THAT(dem.notes, Contains("band 3 of 3 was read"));
}

TEST(Dem, ReadsArcInfoAscii) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.asc",
                                        "ncols 3\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize "
                                        "25\nNODATA_value -9999\n1 2 3\n4 -9999 6\n");
  const Heightfield field = read_dem(path).heights;
  EXPECT_EQ(field.at(2, 0), 3);
  EXPECT_TRUE(std::isnan(field.at(1, 1)));
  EXPECT_EQ(field.cell_x, 25);
  EXPECT_EQ(field.georeference.transform[3], 2050);
}

TEST(Dem, ReadsAnSrtmTile) {
  const TemporaryFolder folder;
  // 1201² big-endian int16; the name places it.
  std::string tile;
  for (int j = 0; j < 1201; ++j) {
    for (int i = 0; i < 1201; ++i) {
      const int h = i == 600 && j == 600 ? -32768 : 100 + i % 50 + j;
      tile += static_cast<char>((h >> 8) & 0xFF);
      tile += static_cast<char>(h & 0xFF);
    }
  }
  const Dem dem = read_dem(folder.write("N44W070.hgt", tile));
  EXPECT_EQ(dem.heights.width, 1201);
  EXPECT_EQ(dem.heights.at(7, 1200), 1307);
  EXPECT_EQ(height_range(dem.heights).no_data, 1U);
  EXPECT_NEAR(dem.heights.cell_x, 66.27, 0.01);
  EXPECT_THAT(dem.notes, Contains("cells of 3″ are 66.3 m × 92.6 m at 44.5° N"));
}

TEST(Dem, ReadsAVirtualRasterByFileAndInline) {
  const TemporaryFolder folder;
  metres().write(folder / "a.tif");
  const std::string xml = fmt::format(
      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><GeoTransform>0, 5, 0, 0, 0, -5</GeoTransform>"
      "<VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"0\">{}"
      "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"1\" yOff=\"1\" xSize=\"3\" ySize=\"2\"/>"
      "<DstRect xOff=\"0\" yOff=\"0\" xSize=\"3\" ySize=\"2\"/></SimpleSource></VRTRasterBand></VRTDataset>",
      folder / "a.tif");
  for (const std::string& path : {xml, folder.write("a.vrt", xml)}) {
    const Heightfield field = read_dem(path).heights;
    EXPECT_THAT(field.heights, testing::ElementsAre(111, 112, 113, 121, 122, 123));
    EXPECT_EQ(field.cell_x, 5);
  }
}

TEST(Dem, OneSampleIsATerrain) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = file.depth = 1;
  file.write(folder / "a.tif");
  expect_ramp(read_dem(folder / "a.tif").heights, 1, 1);
}

TEST(Dem, WritesGeoTiffThatReadsBackTheSame) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = 150;
  file.depth = 131;
  file.no_data = 150;
  file.write(folder / "a.tif");
  const Heightfield first = read_dem(folder / "a.tif").heights;
  write_geotiff(folder / "new/b.tif", first);
  const Dem second = read_dem(folder / "new/b.tif");
  EXPECT_EQ(checksum(first), checksum(second.heights));
  EXPECT_EQ(first.georeference.transform, second.heights.georeference.transform);
  OGRSpatialReference a, b;
  a.importFromWkt(first.georeference.crs.c_str());
  b.importFromWkt(second.heights.georeference.crs.c_str());
  EXPECT_TRUE(a.IsSame(&b));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 1);

  Heightfield unplaced = first;
  unplaced.georeference = {};
  unplaced.cell_x = 0.05F;
  write_geotiff(folder / "c.tif", unplaced);
  EXPECT_EQ(checksum(read_dem(folder / "c.tif").heights), checksum(unplaced));
}

TEST(Dem, PrintsNothingAndHoldsNoMoreThanItMust) {
  const TemporaryFolder folder;
  RasterFile file = metres();
  file.width = file.depth = 2000;
  file.options = {"TILED=YES", "COMPRESS=LZW"};
  file.write(folder / "a.tif");
  (void)read_dem(folder / "a.tif");  // what GDAL allocates once stays
  testing::internal::CaptureStderr();
  HeapCounter::reset_peak();
  const HeapScope scope;
  const std::int64_t before = HeapCounter::live();
  DemOptions options;
  options.width = options.depth = 100;
  const Dem dem = read_dem(folder / "a.tif", options);
  // 16 MB in the file. A strip and its sums are well below 2 MB.
  EXPECT_LT(HeapCounter::peak() - before, 3 << 20);
  EXPECT_LT(scope.held(), 100 << 10);
  EXPECT_EQ(dem.heights.width, 100);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Dem, ManyThreadsReadAtOnce) {
  const TemporaryFolder folder;
  metres().write(folder / "a.tif");
  folder.write("bad.tif", "no raster");
  std::atomic<int> good{0}, bad{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 10; ++k) {
        if (t % 2 == 0) {
          good += read_dem(folder / "a.tif").heights.at(5, 3) == 135.0F;
        } else {
          try {
            (void)read_dem(folder / "bad.tif");
          } catch (const Error& error) {
            bad += std::string_view(error.what()).find("bad.tif") != std::string_view::npos;
          }
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 40);
  EXPECT_EQ(bad, 40);
}

TEST(Dem, InterruptStopsReading) {
  const TemporaryFolder folder;
  metres().write(folder / "a.tif");
  Progress progress;
  Progress::interrupt();
  const Failure failure = failure_of([&] { (void)read_dem(folder / "a.tif", {}, &progress); });
  Progress::clear_interrupt();
  EXPECT_EQ(failure.code, ExitCode::kInterrupted);
}

}  // namespace
}  // namespace terrabench
