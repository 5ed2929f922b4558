// Pictures are read as they are stored: every bit, and no gamma.
#include <gtest/gtest.h>

#include "terrain/image.h"
#include "terrain/source.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/png_bytes.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

std::string wide(std::initializer_list<int> values) {
  std::string bytes;
  for (const int v : values) bytes += {static_cast<char>(v >> 8), static_cast<char>(v)};
  return bytes;
}

std::vector<std::uint16_t> read(const std::string& png) {
  const TemporaryFolder folder;
  return read_grey_png(folder.write("a.png", png)).values;
}

using Values = std::vector<std::uint16_t>;

TEST(GreyImage, KeepsAllSixteenBits) {
  EXPECT_EQ(read(png_bytes(4, 1, 16, 0, wide({0, 1, 300, 65535}))), (Values{0, 1, 300, 65535}));
  EXPECT_EQ(read(png_bytes(1, 2, 16, 2, wide({300, 300, 300, 0, 65535, 0}))), (Values{300, 38469}));
}

TEST(GreyImage, ScalesFewerBits) {
  EXPECT_EQ(read(png_bytes(4, 1, 8, 0, std::string("\0\1\x80\xFF", 4))), (Values{0, 257, 128 * 257, 65535}));
  EXPECT_EQ(read(png_bytes(4, 1, 2, 0, "\x1B")), (Values{0, 21845, 43690, 65535}));
  EXPECT_EQ(
      read(png_bytes(2, 1, 8, 3, std::string("\0\1", 2), png_chunk("PLTE", "\x40\x40\x40\xFF\xFF\xFF"))),
      (Values{64 * 257, 65535}));
}

TEST(GreyImage, TransparentPixelsAreWhite) {
  EXPECT_EQ(read(png_bytes(3, 1, 16, 4, wide({100, 65535, 100, 0, 0, 32768}))), (Values{100, 65535, 32767}));
  const std::string transparent_grey = png_chunk("tRNS", std::string("\0\7", 2));
  EXPECT_EQ(read(png_bytes(2, 1, 8, 0, "\7\x8", transparent_grey)), (Values{65535, 8 * 257}));
}

TEST(GreyImage, NothingSaysHowBrightAPixelIsButItsNumber) {
  const Values stored{0, 64 * 257, 128 * 257, 65535};
  const std::string srgb = png_chunk("sRGB", std::string(1, '\0'));
  for (const std::string& chunks :
       {std::string(), png_chunk("gAMA", big_endian(100000)), png_chunk("gAMA", big_endian(45455)), srgb}) {
    EXPECT_EQ(read(png_bytes(4, 1, 8, 0, std::string("\0\x40\x80\xFF", 4), chunks)), stored);
    EXPECT_EQ(read(png_bytes(4, 1, 16, 0, wide({0, 64 * 257, 128 * 257, 65535}), chunks)), stored);
    const TemporaryFolder folder;
    const Image image = read_picture(
        folder.write("a.png", png_bytes(4, 1, 16, 0, wide({0, 64 * 257, 128 * 257, 65535}), chunks)));
    EXPECT_EQ(image.pixel(2, 0), (Rgb{128, 128, 128}));
  }
}

TEST(GreyImage, ADrawingOfSixteenBitsIsTheLandOfItsTwin) {
  const TemporaryFolder folder;
  const std::string options = ",cell=1,sea_level=0,peak=1000,smoothing=0";
  const std::string rows8("\0\x40\x80\xFF\0\x40\x80\xFF", 8);
  std::string rows16;
  for (const char c : rows8) rows16 += {c, c};
  const TerrainSource fine =
      open_terrain("drawing:" + folder.write("16.png", png_bytes(4, 2, 16, 0, rows16)) + options);
  const TerrainSource coarse =
      open_terrain("drawing:" + folder.write("8.png", png_bytes(4, 2, 8, 0, rows8)) + options);
  EXPECT_EQ(fine.heights->heights, coarse.heights->heights);
  EXPECT_NEAR(fine.heights->at(1, 1), 1000.0 * 64 / 255, 0.001);
  EXPECT_NEAR(fine.heights->at(2, 1), 1000.0 * 128 / 255, 0.001);
  // Between two grey levels of 8 bits.
  rows16[1] = '\x40';
  const TerrainSource between =
      open_terrain("drawing:" + folder.write("b.png", png_bytes(4, 2, 16, 0, rows16)) + options);
  EXPECT_NEAR(between.heights->at(0, 0), 1000.0 * 64 / 65535, 0.001);
}

TEST(GreyImage, DamagedPngsAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = png_bytes(4, 1, 16, 0, wide({0, 1, 300, 65535}));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string path = folder.write("cut.png", whole.substr(0, size));
    EXPECT_EQ(failure_of([&] { (void)read_grey_png(path); }).code, ExitCode::kBadInput) << size;
  }
  std::string changed = whole;
  changed[50] ^= 1;
  const std::string path = folder.write("changed.png", changed);
  EXPECT_EQ(failure_of([&] { (void)read_grey_png(path); }).code, ExitCode::kBadInput);
}

}  // namespace
}  // namespace terrabench
