#include "terrain/image.h"

#include <gtest/gtest.h>

#include <string>

#include "terrain/files.h"
#include "terrain/metrics/image_error.h"
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
    write_picture(folder / "a.png", image);
    const Image back = read_picture(folder / "a.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, image.rgb);
  }
}

TEST(Image, WebpKeepsDrawingsExactlyAndLooksLikeRenderings) {
  const TemporaryFolder folder;
  Image drawing(300, 200, {255, 255, 255}), rendering(300, 200, {});
  std::uint32_t state = 1;
  for (int y = 0; y < 200; ++y) {
    drawing.set(y, y, {0, 56, 168});
    for (int x = 0; x < 300; ++x) {
      state = state * 1664525U + 1013904223U;
      const auto v = static_cast<std::uint8_t>(x / 2 + y / 4 + (state >> 29));
      rendering.set(x, y, {v, static_cast<std::uint8_t>(v / 2), 60});
    }
  }
  for (const Image& image : {drawing, rendering}) {
    write_picture(folder / "a.webp", image);
    write_picture(folder / "a.png", image);
    const std::string bytes = read_file(folder / "a.webp");
    EXPECT_EQ(picture_size(bytes, ""), picture_size(read_file(folder / "a.png"), ""));
    EXPECT_LT(2 * bytes.size(), read_file(folder / "a.png").size());
    EXPECT_GE(psnr(image, read_picture(folder / "a.webp")), 38);
    write_picture(folder / "a.webp", image);
    EXPECT_EQ(read_file(folder / "a.webp"), bytes);
  }
  EXPECT_NE(read_picture(folder / "a.webp").rgb, rendering.rgb);
  write_picture(folder / "a.webp", drawing);
  EXPECT_EQ(read_picture(folder / "a.webp").rgb, drawing.rgb);
}

TEST(Image, TransparentPixelsOfWebpAreWhite) {
  const TemporaryFolder folder;
  // Without losses: {100, 50, 0}, and a transparent pixel.
  const std::string bytes(
      "RIFF\x1e\0\0\0WEBPVP8L\x11\0\0\0\x2f\x01\0\0\x10\x0f\x30\x32\x43\x16\xf3\x1f\x38\x32\xa2\xff\x01\0",
      38);
  EXPECT_EQ(read_picture(folder.write("a.webp", bytes)).rgb,
            (std::vector<std::uint8_t>{100, 50, 0, 255, 255, 255}));
}

TEST(Image, DamagedPicturesAreRefused) {
  const TemporaryFolder folder;
  for (const char* const name : {"a.png", "a.webp"}) {
    write_picture(folder / name, pattern(64, 64));
    const std::string whole = read_file(folder / name);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{7}, std::size_t{15}, std::size_t{30}, whole.size() / 2}) {
      const std::string path = folder.write("cut", whole.substr(0, size));
      EXPECT_EQ(failure_of([&] { (void)read_picture(path); }).code, ExitCode::kBadInput) << name << size;
      if (size >= 20) continue;
      EXPECT_EQ(failure_of([&] { (void)picture_size(whole.substr(0, size), name); }).code,
                ExitCode::kBadInput);
    }
    // A PNG's header that promises 2^31 - 1 pixels each way, or a WebP's that promises 16,384.
    std::string huge = whole;
    if (name == std::string("a.png")) {
      for (const std::size_t at : {16, 20}) huge.replace(at, 4, "\x7F\xFF\xFF\xFF");
    } else {
      huge.replace(21, 3, "\xFF\xFF\xFF");
    }
    const std::string path = folder.write("huge", huge);
    EXPECT_EQ(failure_of([&] { (void)read_picture(path); }).code, ExitCode::kBadInput) << name;
  }
}

TEST(Image, WritingWhereItCannotBeIsAnEnvironmentError) {
  EXPECT_EQ(failure_of([] { write_picture("/proc/terrabench/a.png", Image(2, 2, {})); }).code,
            ExitCode::kEnvironment);
}

}  // namespace
}  // namespace terrabench
