// The DEM reader and writer on what cannot work: each names the file, says what is wrong and what to do, and
// leaves nothing behind.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

class BadDem : public testing::Test {
 protected:
  void SetUp() override { testing::internal::CaptureStderr(); }
  void TearDown() override { EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "GDAL spoke past us"; }

  // Reads what must fail as bad input, naming the file and giving advice.
  std::string refused(const std::string& path, const DemOptions& options = {}) {
    const Failure failure = failure_of([&] { (void)read_dem(path, options); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << failure.what;
    EXPECT_THAT(failure.what, HasSubstr(path));
    EXPECT_FALSE(failure.advice.empty());
    return failure.what + " | " + failure.advice;
  }
  std::string refused(RasterFile file, const DemOptions& options = {}) {
    if (!file.transform) file.transform = kUtm;
    file.write(folder_ / "bad.tif");
    return refused(folder_ / "bad.tif", options);
  }

  TemporaryFolder folder_;
};

TEST_F(BadDem, MissingFile) {
  EXPECT_THAT(refused(folder_ / "none.tif"), HasSubstr("no such file"));
  EXPECT_EQ(failure_of([] { (void)read_dem(""); }).code, ExitCode::kBadInput);
}

TEST_F(BadDem, TextNamedTif) {
  EXPECT_THAT(refused(folder_.write("a.tif", "hello\n")), HasSubstr("cannot be opened"));
}

TEST_F(BadDem, EmptyFileAndFolder) {
  refused(folder_.write("a.tif", ""));
  refused(folder_.path().string());
}

TEST_F(BadDem, TiffCutAtAnyLengthNeverPassesSilently) {
  RasterFile file;
  file.transform = kUtm;
  file.width = file.depth = 64;
  for (const char* const compression : {"COMPRESS=NONE", "COMPRESS=DEFLATE", "COMPRESS=LZW"}) {
    file.options = {compression, "BLOCKYSIZE=8"};
    file.write(folder_ / "whole.tif");
    const std::string whole = read_file(folder_ / "whole.tif");
    const std::vector<float> heights = read_dem(folder_ / "whole.tif").heights.heights;
    for (int k = 1; k < 20; ++k) {
      const std::string path = folder_.write("cut.tif", whole.substr(0, whole.size() * k / 20));
      refused(path);
    }
    const std::string path = folder_.write("cut.tif", whole.substr(0, whole.size() - 1));
    refused(path);
  }
}

TEST_F(BadDem, OtherFormatsCutShort) {
  const std::string asc = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 25\n1 2 3\n4 5";
  EXPECT_THAT(refused(folder_.write("a.asc", asc)), HasSubstr("cannot be read"));
  refused(folder_.write("N10E010.hgt", std::string(1201 * 1201 * 2 - 2, '\1')));
  RasterFile raw;
  raw.format = "ENVI";
  raw.transform = kUtm;
  raw.write(folder_ / "raw.img");
  const std::string image = read_file(folder_ / "raw.img");
  refused(folder_.write("raw.img", image.substr(0, image.size() / 2)));
  refused(folder_.write(
      "a.vrt",
      "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Int16\" band=\"1\">"
      "<SimpleSource><SourceFilename>none.tif</SourceFilename></SimpleSource></VRTRasterBand>"
      "</VRTDataset>"));
}

TEST_F(BadDem, PngCutShort) {
  RasterFile file;
  file.width = file.depth = 200;
  file.type = GDT_Byte;
  file.value = [](int i, int j) { return (i * 7919 + j * 104729) % 251; };
  file.write(folder_ / "a.tif");
  GDALDataset* const source = GDALDataset::Open((folder_ / "a.tif").c_str());
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("PNG");
  GDALClose(driver->CreateCopy((folder_ / "a.png").c_str(), source, 0, nullptr, nullptr, nullptr));
  GDALClose(source);
  EXPECT_EQ(read_dem(folder_ / "a.png").heights.at(5, 3), (5 * 7919 + 3 * 104729) % 251);
  const std::string whole = read_file(folder_ / "a.png");
  refused(folder_.write("cut.png", whole.substr(0, whole.size() / 2)));
}

TEST_F(BadDem, AllNoData) {
  RasterFile file;
  file.no_data = 5;
  file.value = [](int, int) { return 5; };
  EXPECT_THAT(refused(file), HasSubstr("no sample holds a height"));
  file.no_data.reset();
  file.value = [](int i, int) { return i % 2 == 0 ? NAN : INFINITY; };
  EXPECT_THAT(refused(file), HasSubstr("no sample holds a height"));
}

TEST_F(BadDem, CellsWithoutSize) {
  // A TIFF cannot hold these; VRT can.
  for (const char* const transform :
       {"10, 0, 0, 10, 0, -5", "10, 5, 0, 10, 0, 0", "10, nan, 0, 10, 0, -5", "10, 5, 0, inf, 0, -5",
        "10, 1e-300, 0, 10, 0, -5", "0, 1e300, 0, 0, 0, -1"}) {
    const std::string path = folder_.write(
        "a.vrt", fmt::format("<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><GeoTransform>{}</GeoTransform>"
                             "<VRTRasterBand dataType=\"Int16\" band=\"1\"/></VRTDataset>",
                             transform));
    EXPECT_THAT(refused(path),
                testing::AnyOf(HasSubstr("no size"), HasSubstr("no numbers"), HasSubstr("would be")))
        << transform;
  }
}

TEST_F(BadDem, RotatedGrid) {
  RasterFile file;
  file.transform = {500000, 20, 5, 5100000, 5, -20};
  EXPECT_THAT(refused(file), HasSubstr("gdalwarp"));
  file.transform = {500000, 0, 20, 5100000, 20, 0};
  EXPECT_THAT(refused(file), HasSubstr("gdalwarp"));
}

TEST_F(BadDem, DegreesBeyondThePole) {
  RasterFile file;
  file.epsg = 4326;
  EXPECT_THAT(refused(file), HasSubstr("middle latitude"));
}

TEST_F(BadDem, ComplexNumbers) {
  for (const GDALDataType type : {GDT_CInt16, GDT_CFloat64}) {
    RasterFile file;
    file.type = type;
    EXPECT_THAT(refused(file), HasSubstr("values, not heights"));
  }
}

TEST_F(BadDem, ScaleThatFlattensEverything) {
  RasterFile file;
  file.scale = 0;
  EXPECT_THAT(refused(file), HasSubstr("scaled by 0"));
}

TEST_F(BadDem, WrongBandOrWindowIsAUsageError) {
  RasterFile file;
  file.write(folder_ / "a.tif");
  const auto code = [&](const DemOptions& options) {
    return failure_of([&] { (void)read_dem(folder_ / "a.tif", options); }).code;
  };
  DemOptions options;
  for (const int band : {0, 2, -1}) {
    options.band = band;
    EXPECT_EQ(code(options), ExitCode::kUsage);
  }
  options.band = 1;
  const int kMax = std::numeric_limits<int>::max();
  for (const DemWindow window :
       {DemWindow{0, 0, 7, 4}, {-1, 0, 2, 2}, {5, 3, 2, 1}, {1, 1, 0, 0}, {1, 1, kMax, kMax}}) {
    options.window = window;
    EXPECT_EQ(code(options), ExitCode::kUsage);
  }
  options.window = {};
  options.width = -3;
  EXPECT_EQ(code(options), ExitCode::kUsage);
}

TEST_F(BadDem, ABillionPixelsAreRefusedWithAWayOutThatWorks) {
  // Sparse: a billion samples in a file of kilobytes.
  RasterFile file;
  file.transform = kUtm;
  file.width = file.depth = 40000;
  file.type = GDT_Byte;
  file.options = {"SPARSE_OK=YES", "TILED=YES", "BLOCKXSIZE=4096", "BLOCKYSIZE=4096"};
  file.value = nullptr;
  const std::string said = refused(file);
  EXPECT_THAT(said, HasSubstr("40000×40000"));
  EXPECT_THAT(said, HasSubstr("crop"));
  EXPECT_THAT(said, HasSubstr("resample"));
  DemOptions options;
  options.window = {39000, 39000, 1000, 1000};
  EXPECT_EQ(read_dem(folder_ / "bad.tif", options).heights.heights.size(), 1000000U);
  options.window = {10000, 0, 16384, 4096};
  options.width = 512;
  options.depth = 128;
  EXPECT_EQ(read_dem(folder_ / "bad.tif", options).heights.heights.size(), 65536U);
}

TEST_F(BadDem, LimitsCountTheResultNotTheFile) {
  RasterFile file;
  file.transform = kUtm;
  file.width = file.depth = 100;
  DemOptions options;
  options.max_samples = 2500;
  refused(file, options);
  options.width = options.depth = 50;
  EXPECT_EQ(read_dem(folder_ / "bad.tif", options).heights.width, 50);
  // Enlarging may not get around it.
  options.width = options.depth = 50000;
  refused(folder_ / "bad.tif", options);
}

TEST_F(BadDem, GarbageOfAnyKindIsRefused) {
  std::mt19937 random(7);
  for (const char* const name : {"a.tif", "a.asc", "a.png", "a.hgt", "a.dem", "a.vrt", "a.img", "a.nc"}) {
    for (const int size : {1, 7, 100, 4096}) {
      std::string noise(static_cast<std::size_t>(size), '\0');
      for (char& c : noise) c = static_cast<char>(random());
      refused(folder_.write(name, noise));
    }
  }
}

TEST_F(BadDem, WritingWhereItCannotBeLeavesNothing) {
  Heightfield field;
  field.width = field.depth = 3;
  field.heights.assign(9, 1.0F);
  folder_.write("file", "in the way");
  EXPECT_EQ(failure_of([&] { write_geotiff(folder_ / "file/a.tif", field); }).code, ExitCode::kEnvironment);
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_EQ(failure_of([&] { write_geotiff(folder_ / "folder", field); }).code, ExitCode::kEnvironment);
  EXPECT_EQ(failure_of([&] { write_geotiff("/proc/terrabench/a.tif", field); }).code, ExitCode::kEnvironment);
  EXPECT_THAT(folder_.names(), testing::UnorderedElementsAre("file", "folder"));
}

}  // namespace
}  // namespace terrabench
