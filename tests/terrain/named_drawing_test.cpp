// Drawings by name: a user's picture becomes terrain, with the adjustments that follow its name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "terrain/files.h"
#include "terrain/source.h"
#include "terrain/sources/drawing/drawing.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/png_bytes.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class NamedDrawingTest : public ::testing::Test {
 protected:
  NamedDrawingTest() { write_picture(file_, picture_); }
  std::string named(std::string_view rest = "") const { return "drawing:" + file_ + std::string(rest); }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "coast.png";
  Image picture_ = example_drawing(64, 3);
};

TEST_F(NamedDrawingTest, IsTheLandOfThePicture) {
  const TerrainSource source = open_terrain(named());
  ASSERT_TRUE(source.heights);
  EXPECT_EQ(source.name, named());
  EXPECT_EQ(source.checksum, checksum(land_from_drawing(picture_, {})));
  EXPECT_THAT(source.notes, ElementsAre(HasSubstr("black is -100 m")));
}

TEST_F(NamedDrawingTest, TakesEveryAdjustment) {
  const TerrainSource source =
      open_terrain(named(",cell=10,sea_level=0.5,peak=300,seabed=0.25,smoothing=4,mountains=0.9"));
  const DrawingOptions options{
      .cell = 10, .sea_level = 0.5F, .peak = 300, .seabed = 0.25F, .smoothing = 4, .mountains = 0.9F};
  EXPECT_EQ(source.checksum, checksum(land_from_drawing(picture_, options)));
  EXPECT_EQ(source.heights->cell_x, 10);
  EXPECT_NE(open_terrain(named(",peak=300")).checksum, open_terrain(named()).checksum);
}

TEST_F(NamedDrawingTest, FileNamesMayHoldCommas) {
  for (const char* name : {"a,b.png", "a,peak=7.png"}) {
    write_picture(folder_ / name, picture_);
    EXPECT_EQ(parse_drawing(folder_ / name).file, folder_ / name);
  }
  const NamedDrawing adjusted = parse_drawing(folder_ / "a,b.png,peak=7");
  EXPECT_EQ(adjusted.file, folder_ / "a,b.png");
  EXPECT_EQ(adjusted.options.peak, 7);
}

TEST_F(NamedDrawingTest, IsNoDemButAFile) {
  EXPECT_FALSE(names_dem_file(named()));
  EXPECT_TRUE(names_dem_file(file_));
  EXPECT_EQ(terrain_file(named(",peak=5")), file_);
  EXPECT_EQ(terrain_file(file_), file_);
  EXPECT_EQ(terrain_file("caves"), "");
}

TEST_F(NamedDrawingTest, RefusesAdjustmentsThatCannotBe) {
  const auto refused = [&](std::string_view rest, const std::string& what) {
    const Failure failure = failure_of([&] { open_terrain(named(rest)); });
    EXPECT_EQ(failure.code, ExitCode::kUsage) << rest;
    EXPECT_THAT(failure.what, HasSubstr(what)) << rest;
  };
  refused(",peek=3", "peek");
  refused(",peak=high", "peak");
  refused(",peak=-1", "peak");
  refused(",peak=nan", "peak");
  refused(",sea_level=1", "sea_level");
  refused(",smoothing=2000", "smoothing");
  refused(",peak=3,", "");
  const Failure word = failure_of([&] { parse_drawing("x.png,peak=3,high"); });
  EXPECT_EQ(word.what, "invalid assignment 'high': expected name=value");
}

TEST_F(NamedDrawingTest, RefusesWhatIsNoPicture) {
  const auto refused = [&](const std::string& name, const std::string& what) {
    const Failure failure = failure_of([&] { open_terrain("drawing:" + name); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << name;
    EXPECT_THAT(failure.what, HasSubstr(what)) << name;
    EXPECT_THAT(failure.what, HasSubstr(name)) << name;
    EXPECT_NE(failure.advice, "") << name;
  };
  refused(folder_.write("words.png", "no picture at all"), "");
  refused(folder_.write("empty.png", ""), "");
  refused(folder_ / "missing.png", "");
  const std::string whole = read_file(file_);
  refused(folder_.write("cut.png", whole.substr(0, whole.size() / 2)), "");
  write_picture(folder_ / "dot.png", Image(1, 1, {9, 9, 9}));
  refused(folder_ / "dot.png", "1 × 1");
  // 40,000 × 25,000 grey pixels that are not there.
  const std::string header("\0\0\x9C\x40\0\0\x61\xA8\x08\0\0\0\0", 13);
  refused(folder_.write("huge.png", "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + png_chunk("IDAT", "x")),
          "too many pixels");
}

}  // namespace
}  // namespace terrabench
