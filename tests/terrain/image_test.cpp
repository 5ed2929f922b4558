#include "terrain/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "terrain/files.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

Image pattern(int width, int height) {
  Image image(width, height, {1, 2, 3});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; x += 2) {
      image.set(x, y, {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y * 7), 200});
    }
  }
  return image;
}

TEST(Image, StartsFilledAndSetsPixels) {
  Image image(3, 2, {9, 8, 7});
  EXPECT_EQ(image.pixel(2, 1), (Rgb{9, 8, 7}));
  image.set(1, 1, {1, 2, 3});
  EXPECT_EQ(image.pixel(1, 1), (Rgb{1, 2, 3}));
  EXPECT_EQ(image.pixel(0, 1), (Rgb{9, 8, 7}));
  EXPECT_EQ(image.rgb.size(), 18U);
}

TEST(Image, PngKeepsEveryPixel) {
  const TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {255, 33}, {7, 400}}) {
    const Image image = pattern(width, height);
    write_png(folder / "a.png", image);
    const Image back = read_png(folder / "a.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, image.rgb);
  }
}

// Grey noise of `levels` levels, in which no filter finds anything.
Image noise(int width, int height, std::uint32_t levels) {
  Image image(width, height, {});
  std::uint32_t state = 1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      state = state * 1664525U + 1013904223U;
      const auto v = static_cast<std::uint8_t>((state >> 16) % levels);
      image.set(x, y, {v, static_cast<std::uint8_t>(255 - v), 77});
    }
  }
  return image;
}

TEST(Image, FewColoursTakeFewBytesAndStayExact) {
  const TemporaryFolder folder;
  for (const std::uint32_t levels : {1U, 2U, 16U, 255U, 256U}) {
    const Image image = noise(200, 100, levels);
    write_png(folder / "a.png", image);
    EXPECT_EQ(read_png(folder / "a.png").rgb, image.rgb) << levels;
    EXPECT_LT(read_file(folder / "a.png").size(), 200U * 100U + 2000U) << levels;
  }
  Image image = noise(200, 100, 256);
  image.set(150, 90, {1, 2, 3});  // the 257th
  write_png(folder / "a.png", image);
  EXPECT_EQ(read_png(folder / "a.png").rgb, image.rgb);
}

TEST(Image, WithFewColoursKeepsFlatAreasAndStaysNear) {
  Image image(300, 200, {255, 255, 255});
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 150; ++x) {  // half of it in 30,000 colours
      image.set(x, y, {static_cast<std::uint8_t>(x + 50), static_cast<std::uint8_t>(y), 60});
    }
  }
  for (int x = 0; x < 300; ++x) image.set(x, 100, {0, 56, 168});
  const Image few = with_few_colours(image);
  std::set<Rgb> colours;
  double squares = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 300; ++x) {
      colours.insert(few.pixel(x, y));
      for (int c = 0; c < 3; ++c) squares += std::pow(few.pixel(x, y)[c] - image.pixel(x, y)[c], 2);
    }
  }
  EXPECT_LE(colours.size(), 256U);
  EXPECT_GT(colours.size(), 200U);
  // A grid of 16 × 16 cells of 9.4 × 12.5 levels would be off by 3.6² in one and 2.7² in the other, over
  // half.
  EXPECT_LT(squares / (300 * 200), 10.5);
  EXPECT_EQ(few.pixel(250, 20), (Rgb{255, 255, 255}));
  EXPECT_EQ(few.pixel(20, 100), (Rgb{0, 56, 168}));
  EXPECT_EQ(with_few_colours(few).rgb, few.rgb);
  EXPECT_EQ(with_few_colours(image, 1).pixel(3, 3), with_few_colours(image, 1).pixel(299, 199));
}

TEST(Image, DamagedPngsAreRefused) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", pattern(64, 64));
  const std::string whole = read_file(folder / "a.png");
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{30}, whole.size() / 2}) {
    const std::string path = folder.write("cut.png", whole.substr(0, size));
    EXPECT_EQ(failure_of([&] { (void)read_png(path); }).code, ExitCode::kBadInput) << size;
  }
  // A header that promises 2^31 - 1 pixels each way.
  std::string huge = whole;
  for (const std::size_t at : {16, 20}) huge.replace(at, 4, "\x7F\xFF\xFF\xFF");
  const std::string path = folder.write("huge.png", huge);
  EXPECT_EQ(failure_of([&] { (void)read_png(path); }).code, ExitCode::kBadInput);
}

TEST(Image, WritingWhereItCannotBeIsAnEnvironmentError) {
  EXPECT_EQ(failure_of([] { write_png("/proc/terrabench/a.png", Image(2, 2, {})); }).code,
            ExitCode::kEnvironment);
}

}  // namespace
}  // namespace terrabench
