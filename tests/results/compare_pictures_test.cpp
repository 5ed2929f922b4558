#include "results/compare/compare_pictures.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "results/compare/compare.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// A slope of grey, brighter by `step`.
Image slope(int step, int width = 40, int height = 30) {
  Image image(width, height, {0, 0, 0});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto grey = static_cast<std::uint8_t>(50 + 3 * x + y + step);
      image.set(x, y, {grey, grey, grey});
    }
  }
  return image;
}

double decibels(double mean_square) { return 10 * std::log10(255 * 255 / mean_square); }

class ComparePictures : public FolderTest {
 protected:
  void draw(const std::string& side, const std::string& file, const Image& image) {
    write_picture(folder_ / side / file, image);
  }
  PictureComparison compared(const PictureLimits& limits = {}) {
    return compare_pictures(folder_ / "a", folder_ / "b", limits);
  }
  std::string text() { return pictures_text(compared(), false); }
  ComparedPicture only() {
    const PictureComparison comparison = compared();
    EXPECT_EQ(comparison.pictures.size(), 1U);
    return comparison.pictures.at(0);
  }
  // A results folder whose record names these pictures, as they are now.
  void record(const std::string& side, const std::vector<std::string>& files) {
    Store store(folder_ / side);
    const Provenance run = fake_provenance();
    store.begin_run(run);
    Record record = fake_record(run, "e", "c");
    for (const std::string& file : files) {
      record.figures.push_back({file, file, "a caption", checksum(read_file(folder_ / side / file))});
    }
    store.append(record);
  }
  PictureComparison of_results() { return compare(folder_ / "a", folder_ / "b").pictures; }
};

TEST_F(ComparePictures, AConstantDifferenceHasAKnownPsnr) {
  for (const int step : {1, 2, 3, 10}) {
    draw("a", "x.png", slope(0));
    draw("b", "x.png", slope(step));
    const ComparedPicture picture = only();
    EXPECT_NEAR(picture.psnr, decibels(step * step), 1e-9);
    EXPECT_GT(picture.ssim, 0.99);
    EXPECT_EQ(picture.differing, 1200U);
    EXPECT_EQ(picture.size, (std::array{40, 30}));
    EXPECT_EQ(picture.change, step <= 2 ? PictureChange::kClose : PictureChange::kDiffers);
  }
}

TEST_F(ComparePictures, ADifferenceOfOnePixelHasAKnownPsnr) {
  Image changed = slope(0);
  changed.set(7, 9, {255, 255, 255});
  const double d = 255 - (50 + 3 * 7 + 9);
  draw("a", "x.png", slope(0));
  draw("b", "x.png", changed);
  const ComparedPicture picture = only();
  EXPECT_NEAR(picture.psnr, decibels(d * d / 1200), 1e-9);
  EXPECT_EQ(picture.differing, 1U);
  EXPECT_THAT(text(), HasSubstr("1 of 40 × 30 pixels differ (0.08333 %)"));
}

// Noise on a flat ground: far in structure while every pixel is near.
TEST_F(ComparePictures, EitherLimitAloneMakesADifference) {
  Image noisy(40, 30, {100, 100, 100});
  for (int y = 0; y < 30; ++y) {
    for (int x = y % 2; x < 40; x += 2) noisy.set(x, y, {102, 102, 102});
  }
  draw("a", "x.png", Image(40, 30, {100, 100, 100}));
  draw("b", "x.png", noisy);
  const ComparedPicture picture = only();
  EXPECT_NEAR(picture.psnr, decibels(2), 1e-9);
  EXPECT_LT(picture.ssim, 0.99);
  EXPECT_EQ(picture.change, PictureChange::kDiffers);
  EXPECT_EQ(compared({40, 0.5}).pictures.at(0).change, PictureChange::kClose);
  EXPECT_EQ(compared({46, 0.5}).pictures.at(0).change, PictureChange::kDiffers);
}

TEST_F(ComparePictures, EqualPixelsInOtherBytesAreClose) {
  draw("a", "x.png", slope(0));
  draw("b", "x.png", slope(0));
  EXPECT_EQ(only().change, PictureChange::kIdentical);
  // A chunk of text before the last chunk, "IEND".
  std::string bytes = read_file(folder_ / "b/x.png");
  bytes.insert(bytes.size() - 12, std::string("\0\0\0\3tEXta\0b\xdc\x49\xa2\x3b", 15));
  write_file(folder_ / "b/x.png", bytes);
  const ComparedPicture picture = only();
  EXPECT_EQ(picture.change, PictureChange::kClose);
  EXPECT_TRUE(std::isinf(picture.psnr));
  EXPECT_NEAR(picture.ssim, 1, 1e-12);
  EXPECT_TRUE(compared({1000, 1 - 1e-9}).passed());
  EXPECT_THAT(text(), HasSubstr("all pixels equal, in other bytes"));
}

TEST_F(ComparePictures, PngAndWebpOfOneNameAreTheSamePicture) {
  draw("a", "x.png", slope(0));
  draw("b", "x.webp", slope(0));
  draw("a", "y.webp", slope(0));
  draw("b", "y.png", slope(9));
  const PictureComparison comparison = compared();
  ASSERT_EQ(comparison.pictures.size(), 2U);
  EXPECT_EQ(comparison.pictures[0].file, "y.webp");
  EXPECT_EQ(comparison.pictures[0].file_after, "y.png");
  EXPECT_EQ(comparison.pictures[0].change, PictureChange::kDiffers);
  EXPECT_EQ(comparison.pictures[1].change, PictureChange::kClose);
}

TEST_F(ComparePictures, TheWorstIsFirst) {
  for (const auto& [file, step] : std::vector<std::pair<std::string, int>>{
           {"a.png", 4}, {"b.png", 0}, {"c.png", 9}, {"d.png", 1}, {"in/e.png", 20}, {"f.png", 0}}) {
    draw("a", file, slope(0));
    draw("b", file, slope(step));
  }
  draw("a", "g.png", slope(0));
  draw("b", "h.PNG", slope(0));
  draw("a", "i.png", slope(0));
  draw("b", "i.png", slope(0, 41));
  write_file(folder_ / "a/readme.txt", "no picture");
  const PictureComparison comparison = compared();
  std::vector<std::string> files;
  for (const ComparedPicture& picture : comparison.pictures) files.push_back(picture.file);
  EXPECT_THAT(
      files, ElementsAre("i.png", "in/e.png", "c.png", "a.png", "d.png", "b.png", "f.png", "g.png", "h.PNG"));
  EXPECT_FALSE(comparison.passed());
  const std::string text = pictures_text(comparison, false);
  EXPECT_THAT(text, testing::StartsWith("pictures: 1 not compared, 3 differs, 1 close, 2 identical, 1 only "
                                        "before, 1 only after (close: at least 40 dB and SSIM 0.99)\n"));
  EXPECT_THAT(text, HasSubstr("* not compared i.png  40 × 30 pixels before, 41 × 30 after\n"));
  EXPECT_THAT(
      text,
      HasSubstr("* differs      in/e.png  22.11 dB, SSIM 0.9872, 1,200 of 40 × 30 pixels differ (100 %)\n"));
  EXPECT_THAT(text, HasSubstr("* only before  g.png\n"));
  EXPECT_THAT(text, HasSubstr("* only after   h.PNG\n"));
  EXPECT_THAT(text, Not(HasSubstr("b.png"))) << "identical files are only counted";
}

TEST_F(ComparePictures, WhatOnlyOneFolderHasIsNoDifference) {
  draw("a", "x.png", slope(0));
  draw("b", "x.png", slope(0));
  draw("a", "y.png", slope(0));
  EXPECT_TRUE(compared().passed());
  EXPECT_EQ(compared().count(PictureChange::kOnlyBefore), 1U);
  for (int i = 0; i < 30; ++i) draw("a", "z" + std::to_string(i) + ".png", slope(0));
  EXPECT_THAT(pictures_text(compared(), false), HasSubstr("… and 21 more that only one folder has"));
}

TEST_F(ComparePictures, ADamagedPictureIsADifference) {
  const std::vector<std::pair<std::string, std::string>> damages = {
      {"empty", ""}, {"text", "this is no picture"}, {"cut", ""}};
  for (const auto& [what, bytes] : damages) {
    draw("a", "x.png", slope(0));
    draw("b", "x.png", slope(1));
    const std::string whole = read_file(folder_ / "b/x.png");
    write_file(folder_ / "b/x.png", what == "cut" ? whole.substr(0, whole.size() / 2) : bytes);
    const ComparedPicture picture = only();
    EXPECT_EQ(picture.change, PictureChange::kNotCompared) << what;
    EXPECT_THAT(picture.reason, HasSubstr("b/x.png")) << "which of the two";
    EXPECT_FALSE(compared().passed()) << what;
  }
}

TEST_F(ComparePictures, FoldersWithNothingInCommonAreRefused) {
  EXPECT_THROW(compared(), Error) << "no folders";
  draw("a", "x.png", slope(0));
  EXPECT_THROW(compared(), Error) << "no second folder";
  draw("b", "y.png", slope(0));
  EXPECT_THROW(compared(), Error) << "no common name";
}

TEST_F(ComparePictures, OfResultsAreThoseThatTheirRecordsName) {
  for (const char* side : {"a", "b"}) {
    const bool after = side[0] == 'b';
    draw(side, "figures/same.png", slope(0));
    draw(side, "figures/near.png", slope(after ? 1 : 0));
    draw(side, "figures/unnamed.png", slope(after ? 50 : 0));
    record(side, {"figures/same.png", "figures/near.png"});
  }
  const PictureComparison comparison = of_results();
  EXPECT_TRUE(comparison.passed());
  EXPECT_EQ(comparison.pictures.size(), 2U);
  EXPECT_EQ(comparison.pictures.at(0).file, "figures/near.png");
  EXPECT_FALSE(compare(folder_ / "a", folder_ / "b", {60, 0.99}).passed());
  const Comparison whole = compare(folder_ / "a", folder_ / "b", {60, 0.99});
  EXPECT_THAT(compare_text(whole, false), HasSubstr("* differs      figures/near.png  48.13 dB"));
  const auto json = nlohmann::json::parse(compare_json(whole));
  EXPECT_FALSE(json["passed"]);
  EXPECT_FALSE(json["pictures"]["passed"]);
  EXPECT_EQ(json["pictures"]["list"][0]["change"], "differs");
  EXPECT_NEAR(json["pictures"]["list"][0]["psnr"], decibels(1), 1e-9);
}

TEST_F(ComparePictures, OfResultsMustBeThereAsRecorded) {
  for (const char* side : {"a", "b"}) {
    for (const char* file : {"kept.png", "lost.png", "other.png"}) draw(side, file, slope(0));
    record(side, {"kept.png", "lost.png", "other.png"});
  }
  EXPECT_TRUE(of_results().passed());
  std::filesystem::remove(folder_ / "a/lost.png");
  draw("b", "other.png", slope(1));
  const PictureComparison comparison = of_results();
  EXPECT_FALSE(comparison.passed());
  EXPECT_EQ(comparison.count(PictureChange::kIdentical), 1U);
  EXPECT_EQ(comparison.count(PictureChange::kNotCompared), 2U);
  const std::string text = pictures_text(comparison, false);
  EXPECT_THAT(text, HasSubstr("lost.png  missing before\n"));
  EXPECT_THAT(text, HasSubstr("other.png  after it is not the picture that its record names\n"));
}

}  // namespace
}  // namespace terrabench
