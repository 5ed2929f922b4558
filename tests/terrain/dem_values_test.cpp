// How the DEM reader takes numbers that files describe badly or not at all: voids, signs, units, colours.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/png_bytes.h"
#include "tests/terrain/raster_file.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

class DemValues : public testing::Test {
 protected:
  Dem read(const RasterFile& file, const std::string& options = "") {
    file.write(path_);
    return read_dem(options.empty() ? path_ : "dem:" + path_ + options);
  }
  Failure refused(const std::string& name) {
    return failure_of([&] { (void)read_dem(name); });
  }
  TemporaryFolder folder_;
  std::string path_ = folder_ / "a.tif";
};

TEST_F(DemValues, UsualNoDataThatNothingDeclaresIsNoHeight) {
  for (const double sentinel : {-32768.0, -32767.0, -9999.0}) {
    for (const GDALDataType type : {GDT_Int16, GDT_Int32, GDT_Float32, GDT_Float64}) {
      RasterFile file = metres();
      file.type = type;
      file.value = [=](int i, int j) { return i == 2 ? sentinel : 10.0 * j; };
      const Dem dem = read(file);
      EXPECT_EQ(height_range(dem.heights).no_data, 4U) << sentinel;
      EXPECT_EQ(height_range(dem.heights).lowest, 0) << sentinel;
      EXPECT_THAT(dem.notes, Contains(HasSubstr(fmt::format("4 of 24 samples are {}", sentinel))));
      const Dem all = read(file, ",nodata=none");
      EXPECT_EQ(height_range(all.heights).lowest, sentinel);
      EXPECT_THAT(all.notes, Not(Contains(HasSubstr("declare"))));
      EXPECT_EQ(height_range(read(file, ",nodata=30").heights).lowest, sentinel)
          << "another number was named";
    }
  }
}

TEST_F(DemValues, WhereNoDataIsDeclaredADepthOf9999MetresIsOne) {
  RasterFile file = metres();
  file.no_data = 7;
  file.value = [](int i, int j) { return i == 0 ? -9999 : i == 1 ? -32768 : i == 2 ? 7 : -9900 - j; };
  const Dem dem = read(file);
  EXPECT_EQ(dem.heights.at(0, 0), -9999);
  EXPECT_TRUE(Heightfield::is_no_data(dem.heights.at(1, 0)));
  EXPECT_TRUE(Heightfield::is_no_data(dem.heights.at(2, 0)));
}

TEST_F(DemValues, SentinelsAreComparedBeforeScaling) {
  RasterFile file = metres();
  file.type = GDT_Int16;
  file.scale = 0.1;
  file.value = [](int i, int) { return i == 0 ? -32768 : 50; };
  EXPECT_EQ(height_range(read(file).heights).lowest, 5);
}

TEST_F(DemValues, ReducedCopiesLeaveTheSentinelsOut) {
  RasterFile file = metres();
  file.value = [](int i, int) { return i % 2 == 0 ? -32768 : 50; };
  file.write(path_);
  DemOptions options;
  options.width = 3;
  options.depth = 2;
  EXPECT_THAT(read_dem(path_, options).heights.heights, Each(50.0F));
}

TEST_F(DemValues, BytesCanBeSigned) {
  RasterFile file = metres();
  file.type = GDT_Byte;
  file.options = {"PIXELTYPE=SIGNEDBYTE"};
  file.value = [](int i, int j) { return i == 0 && j == 0 ? 128 : i == 1 ? 256 - 99 : i == 2 ? 99 : 0; };
  for (const bool declared : {false, true}) {
    if (declared) file.no_data = -128;
    const Dem dem = read(file);
    EXPECT_EQ(dem.heights.at(1, 0), -99);
    EXPECT_EQ(dem.heights.at(2, 0), 99);
    EXPECT_EQ(height_range(dem.heights).no_data, declared ? 1U : 0U);
  }
}

TEST_F(DemValues, HeightsBeyondAThousandKilometresAreRefusedAsAWhole) {
  RasterFile file = metres();
  file.value = [](int i, int j) { return 900000.0 + 50000 * i + 1000 * j; };
  file.write(path_);
  const Failure failure = refused(path_);
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("15 of 24"));
  EXPECT_THAT(failure.advice, HasSubstr("unit=mm"));
  const Heightfield field = read_dem("dem:" + path_ + ",unit=mm").heights;
  EXPECT_EQ(height_range(field).no_data, 0U);
  EXPECT_FLOAT_EQ(field.at(5, 3), 1153);
  EXPECT_EQ(height_range(read(file, ",unit=cm").heights).highest, 11530);
}

TEST_F(DemValues, OptionsReplaceWhatTheFileSays) {
  RasterFile file = metres();
  file.bands = 3;
  file.unit = "m";
  file.no_data = 2100;
  EXPECT_EQ(read(file, ",band=3").heights.at(1, 0), 2101);
  EXPECT_EQ(height_range(read(file, ",band=3").heights).no_data, 1U);
  EXPECT_EQ(height_range(read(file, ",band=3,nodata=none").heights).no_data, 0U);
  EXPECT_EQ(height_range(read(file, ",band=3,nodata=2101").heights).no_data, 1U);
  EXPECT_FLOAT_EQ(read(file, ",unit=ft").heights.at(1, 0), 101 * 0.3048F);
  EXPECT_FLOAT_EQ(read(file, ",unit=us-ft").heights.at(1, 0), static_cast<float>(101 * 1200.0 / 3937));
  for (const char* const options : {",band=0", ",band=4", ",band=x", ",nodata=x", ",unit=league",
                                    ",encoding=jpeg", ",bands=2", ",band=1,band=2", ",encoding=mapbox"}) {
    EXPECT_EQ(refused("dem:" + path_ + options).code, ExitCode::kUsage) << options;
  }
}

TEST_F(DemValues, ANameCanChooseAPart) {
  const Dem middle = read(metres(), ",crop=4x2");
  EXPECT_EQ(middle.heights.width, 4);
  EXPECT_EQ(middle.heights.depth, 2);
  EXPECT_EQ(middle.heights.at(0, 0), 111);
  EXPECT_EQ(middle.heights.georeference.transform[0], kUtm[0] + 30);
  EXPECT_THAT(middle.notes, Contains("the middle 4×2 of its 6×4 samples"));
  const Dem corner = read(metres(), ",crop=2x3+4+1");
  EXPECT_EQ(corner.heights.at(0, 0), 114);
  EXPECT_EQ(corner.heights.depth, 3);
  EXPECT_THAT(corner.notes, Contains("2×3 of its 6×4 samples, from column 4 and row 1"));
  EXPECT_EQ(read_dem_header("dem:" + path_ + ",crop=4x2").width, 4);
  EXPECT_EQ(cropped(path_, {0, 0, 4, 2, true}), "dem:" + path_ + ",crop=4x2");
  EXPECT_EQ(cropped("dem:a.tif,unit=ft", {4, 1, 2, 3}), "dem:a.tif,unit=ft,crop=2x3+4+1");
}

TEST_F(DemValues, APartMustBeSpelledAndLieInside) {
  metres().write(path_);
  for (const char* const part : {"4", "4x", "x2", "4x2+1", "4x2+1+1+1", "0x2", "4x-2", "4x2+-1+0", "4*2"}) {
    const Failure failure = refused("dem:" + path_ + ",crop=" + part);
    EXPECT_EQ(failure.code, ExitCode::kUsage) << part;
    EXPECT_THAT(failure.what, HasSubstr("WIDTHxDEPTH+COLUMN+ROW")) << part;
  }
  for (const char* const part : {"7x2", "4x2+3+0", "4x2+0+3"}) {
    const Failure failure = refused("dem:" + path_ + ",crop=" + part);
    EXPECT_EQ(failure.code, ExitCode::kUsage) << part;
    EXPECT_THAT(failure.what, HasSubstr("does not lie inside its 6×4")) << part;
  }
  DemOptions cropped_before;
  cropped_before.window = {0, 0, 2, 2};
  EXPECT_EQ(failure_of([&] { (void)read_dem("dem:" + path_ + ",crop=4x2", cropped_before); }).code,
            ExitCode::kUsage);
}

TEST(ReadableDem, HasThePartInWords) {
  EXPECT_EQ(readable_dem("dem:my.tif,crop=257x129"), "my.tif, its middle 257 × 129");
  EXPECT_EQ(readable_dem("my.tif,crop=9x5+100+0,unit=ft"), "my.tif, 9 × 5 from column 100, row 0,unit=ft");
  for (const char* const other : {"my.tif", "a,crop=b.tif", "caves"}) EXPECT_EQ(readable_dem(other), other);
}

TEST_F(DemValues, ANameWithOptionsIsATerrain) {
  RasterFile file = metres();
  file.bands = 2;
  file.write(path_);
  const std::string name = "dem:" + path_ + ",band=2";
  const TerrainSource source = open_terrain(name);
  EXPECT_EQ(source.name, name) << "a record of it says what was chosen";
  EXPECT_EQ(source.heights->at(0, 0), 1100);
  EXPECT_EQ(terrain_file(name), path_);
  EXPECT_TRUE(names_dem_file(name));
}

TEST_F(DemValues, AColourPictureIsNoHeights) {
  const std::string png = folder_.write("a.png", png_bytes(2, 1, 8, 2, "abcdef"));
  const Failure failure = refused(png);
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("colour picture"));
  EXPECT_THAT(failure.advice, HasSubstr("encoding=terrarium"));
  EXPECT_EQ(read_dem("dem:" + png + ",band=1").heights.at(0, 0), 'a');
  RasterFile tif = metres();
  tif.bands = 3;
  tif.type = GDT_Byte;
  tif.write(path_);
  EXPECT_THAT(refused(path_).what, HasSubstr("colour picture"));
}

TEST_F(DemValues, ColoursThatEncodeHeightsAreDecoded) {
  const auto bytes = [](std::initializer_list<int> values) {
    std::string text;
    for (const int v : values) text += static_cast<char>(v);
    return text;
  };
  // 256·R + G + B/256 - 32768, and black for no height.
  const std::string terrarium =
      folder_.write("t.png", png_bytes(4, 1, 8, 2, bytes({128, 0, 0, 128, 3, 128, 127, 255, 0, 0, 0, 0})));
  const Dem dem = read_dem("dem:" + terrarium + ",encoding=terrarium");
  EXPECT_EQ(dem.heights.at(0, 0), 0);
  EXPECT_EQ(dem.heights.at(1, 0), 3.5F);
  EXPECT_EQ(dem.heights.at(2, 0), -1);
  EXPECT_TRUE(Heightfield::is_no_data(dem.heights.at(3, 0)));
  EXPECT_THAT(dem.notes, Contains(HasSubstr("Terrarium")));
  // (65536·R + 256·G + B)/10 - 10000; transparent for no height.
  const std::string mapbox =
      folder_.write("m.png", png_bytes(3, 1, 8, 6, bytes({1, 134, 160, 255, 1, 134, 165, 255, 9, 9, 9, 0})));
  const Dem other = read_dem("dem:" + mapbox + ",encoding=mapbox");
  EXPECT_EQ(other.heights.at(0, 0), 0);
  EXPECT_EQ(other.heights.at(1, 0), 0.5F);
  EXPECT_TRUE(Heightfield::is_no_data(other.heights.at(2, 0)));
}

TEST_F(DemValues, AHeaderNeedsNoPixels) {
  RasterFile file = metres();
  file.width = file.depth = 40000;
  file.type = GDT_Int16;
  file.options = {"SPARSE_OK=YES", "TILED=YES"};
  file.value = nullptr;
  file.write(path_);
  const DemHeader header = read_dem_header(path_);
  EXPECT_EQ(header.width, 40000);
  EXPECT_EQ(header.depth, 40000);
  EXPECT_EQ(header.cell_x, 30);
  EXPECT_EQ(header.type, "Int16");
  EXPECT_EQ(header.format, "GTiff");
  EXPECT_THAT(header.too_large, HasSubstr("1600 million"));
  metres().write(path_);
  EXPECT_EQ(read_dem_header(path_).too_large, "");
}

}  // namespace
}  // namespace terrabench
