#include "terrain/image.h"

#include <gtest/gtest.h>

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
