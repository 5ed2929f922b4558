#include "terrain/heightfield.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "terrain/resampling.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

Heightfield field_of(int width, int depth, const std::function<float(int, int)>& height) {
  return test::ground_of(width, depth, height, 10, 20);
}

Heightfield noise(int width, int depth, unsigned seed, double holes = 0) {
  return test::with_holes(test::random_ground(width, depth, seed, -500, 3000, 10, 20), seed + 1, holes);
}

double mean(const Heightfield& field) {
  double sum = 0;
  for (const float h : field.heights) sum += h;
  return sum / static_cast<double>(field.heights.size());
}

TEST(Heightfield, SampleIsExactOnGridPointsAndLinearBetween) {
  const Heightfield field = noise(7, 5, 1);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 7; ++i) {
      EXPECT_EQ(field.sample(10.0F * i, 20.0F * j), field.at(i, j));
    }
  }
  const Heightfield plane = field_of(4, 4, [](int i, int j) { return 3.0F * i - 2.0F * j; });
  EXPECT_FLOAT_EQ(plane.sample(12.5F, 25.0F), 3 * 1.25F - 2 * 1.25F);
}

TEST(Heightfield, SampleOutsideOrBesideAHoleIsNoData) {
  Heightfield field = noise(4, 4, 2);
  for (const auto& [x, z] : {std::pair{-0.1F, 0.F}, {30.1F, 0.F}, {0.F, -1.F}, {0.F, 60.5F}, {NAN, 0.F}}) {
    EXPECT_TRUE(std::isnan(field.sample(x, z))) << x << " " << z;
  }
  field.at(1, 1) = Heightfield::kNoData;
  EXPECT_TRUE(std::isnan(field.sample(5, 10)));
  EXPECT_FALSE(std::isnan(field.sample(25, 50)));
}

TEST(Heightfield, SampleWorksOnDegenerateSizes) {
  EXPECT_EQ(field_of(1, 1, [](int, int) { return 7.0F; }).sample(0, 0), 7.0F);
  const Heightfield line = field_of(1, 3, [](int, int j) { return 10.0F * j; });
  EXPECT_FLOAT_EQ(line.sample(0, 30), 15);
  EXPECT_FLOAT_EQ(line.sample(0, 40), 20);
}

TEST(Heightfield, RangeCountsHolesAndBounds) {
  Heightfield field = noise(300, 300, 3);
  field.at(17, 20) = -4000;
  field.at(299, 299) = 9000;
  for (int i = 0; i < 40; ++i) field.at(i, 7) = Heightfield::kNoData;
  const HeightRange range = height_range(field);
  EXPECT_EQ(range.lowest, -4000);
  EXPECT_EQ(range.highest, 9000);
  EXPECT_EQ(range.no_data, 40U);
  const HeightRange empty = height_range(field_of(2, 2, [](int, int) { return Heightfield::kNoData; }));
  EXPECT_GT(empty.lowest, empty.highest);
  EXPECT_EQ(empty.no_data, 4U);
}

TEST(Heightfield, CropKeepsHeightsCellsAndPlace) {
  Heightfield field = noise(9, 8, 4);
  field.georeference = {"LOCAL", {1000, 10, 0, 5000, 0, -20}};
  const Heightfield part = crop(field, 2, 3, 4, 5);
  ASSERT_EQ(part.heights.size(), 20U);
  for (int j = 0; j < 5; ++j) {
    for (int i = 0; i < 4; ++i) EXPECT_EQ(part.at(i, j), field.at(i + 2, j + 3));
  }
  EXPECT_EQ(part.cell_z, 20);
  EXPECT_EQ(part.georeference.transform, (std::array<double, 6>{1020, 10, 0, 4940, 0, -20}));
  EXPECT_EQ(part.georeference.crs, "LOCAL");
}

TEST(Heightfield, CropOutsideIsAUsageError) {
  const Heightfield field = noise(9, 8, 4);
  const int kMax = std::numeric_limits<int>::max();
  for (const auto& r : std::vector<std::array<int, 4>>{{-1, 0, 2, 2},
                                                       {0, -1, 2, 2},
                                                       {0, 0, 10, 2},
                                                       {0, 0, 0, 2},
                                                       {0, 0, 2, -2},
                                                       {8, 7, 2, 1},
                                                       {1, 1, kMax, 1}}) {
    const Failure failure = failure_of([&] { crop(field, r[0], r[1], r[2], r[3]); });
    EXPECT_EQ(failure.code, ExitCode::kUsage);
    EXPECT_THAT(failure.what, HasSubstr("9×8"));
  }
}

TEST(Heightfield, ChecksumSeesEveryPartAndNothingElse) {
  const Heightfield field = noise(20, 10, 5);
  Heightfield same = field;
  same.georeference.crs = "elsewhere";
  EXPECT_EQ(checksum(field), checksum(same));
  EXPECT_EQ(checksum(field).size(), 32U);
  Heightfield other = field;
  other.at(19, 9) = std::nextafter(other.at(19, 9), 1e9F);
  EXPECT_NE(checksum(field), checksum(other));
  other = field;
  std::swap(other.width, other.depth);
  EXPECT_NE(checksum(field), checksum(other));
  other = field;
  other.cell_z += 1;
  EXPECT_NE(checksum(field), checksum(other));
}

TEST(Resample, TapsCoverTheAxisOnceAndSumToOne) {
  for (int from = 1; from <= 23; ++from) {
    for (int to = 1; to <= 23; ++to) {
      std::vector<double> share(static_cast<std::size_t>(from));
      for (const Taps& taps : resampling_taps(from, to)) {
        double sum = 0;
        for (int s = taps.first; s <= taps.last(); ++s) {
          ASSERT_TRUE(s >= 0 && s < from) << from << " to " << to;
          EXPECT_GT(taps.weight(s), 0) << from << " to " << to;
          sum += taps.weight(s);
          share[s] += taps.weight(s);
        }
        EXPECT_NEAR(sum, 1, 1e-12) << from << " to " << to;
      }
      // Reducing, every old sample counts the same.
      if (to > from) continue;
      for (const double s : share)
        EXPECT_NEAR(s, static_cast<double>(to) / from, 1e-12) << from << " to " << to;
    }
  }
}

TEST(Resample, AConstantStaysConstantAtAnySize) {
  const Heightfield field = field_of(37, 23, [](int, int) { return 123.456F; });
  for (const auto& [w, d] :
       {std::pair{37, 23}, {36, 22}, {5, 3}, {1, 1}, {38, 24}, {200, 100}, {100, 7}, {1, 300}}) {
    const Heightfield out = resample(field, w, d);
    ASSERT_EQ(out.heights.size(), static_cast<std::size_t>(w) * d);
    EXPECT_THAT(out.heights, testing::Each(123.456F)) << w << "×" << d;
    EXPECT_NEAR(out.cell_x * w, field.cell_x * 37, 1e-3);
  }
}

TEST(Resample, ReductionKeepsTheMeanExactlyForAnyRatio) {
  const Heightfield field = noise(120, 90, 6);
  for (const auto& [w, d] : {std::pair{60, 45}, {40, 30}, {1, 1}, {119, 89}, {77, 13}}) {
    EXPECT_NEAR(mean(resample(field, w, d)), mean(field), 1e-3) << w << "×" << d;
  }
}

TEST(Resample, HalvingAveragesFourSamples) {
  const Heightfield out = resample(field_of(4, 2, [](int i, int j) { return 10.0F * i + j; }), 2, 1);
  EXPECT_THAT(out.heights, testing::ElementsAre(5.5F, 25.5F));
  EXPECT_EQ(out.cell_x, 20);
  EXPECT_EQ(out.cell_z, 40);
}

TEST(Resample, EnlargingAPlaneKeepsItAwayFromTheBorder) {
  const Heightfield plane = field_of(10, 10, [](int i, int j) { return 3.0F * i + 7.0F * j; });
  const Heightfield out = resample(plane, 40, 20);
  for (int j = 2; j < 18; ++j) {
    for (int i = 2; i < 38; ++i) {
      const double u = (i + 0.5) / 4 - 0.5, v = (j + 0.5) / 2 - 0.5;
      EXPECT_NEAR(out.at(i, j), 3 * u + 7 * v, 1e-4);
    }
  }
}

TEST(Resample, MovesTheGeoreferenceWithTheCells) {
  Heightfield field = noise(12, 8, 7);
  field.georeference.transform = {500, 10, 0, 900, 0, -20};
  EXPECT_EQ(resample(field, 4, 16).georeference.transform, (std::array<double, 6>{500, 30, 0, 900, 0, -10}));
}

TEST(Resample, AHoleStaysAHoleOfItsSizeAndDoesNotPullHeights) {
  // The west half is a hole.
  const Heightfield field = field_of(16, 16, [](int i, int) { return i < 8 ? Heightfield::kNoData : 50.0F; });
  for (const int size : {4, 8, 32}) {
    const Heightfield out = resample(field, size, size);
    EXPECT_EQ(height_range(out).no_data, static_cast<std::size_t>(size) * size / 2) << size;
    EXPECT_EQ(height_range(out).lowest, 50.0F);
    EXPECT_EQ(height_range(out).highest, 50.0F);
  }
  // One sample of four missing: the mean of the other three.
  Heightfield small = field_of(2, 2, [](int i, int j) { return 1.0F + i + 2.0F * j; });
  small.at(1, 1) = Heightfield::kNoData;
  EXPECT_FLOAT_EQ(resample(small, 1, 1).heights[0], 2.0F);
}

TEST(Resample, RefusesEmptySizes) {
  const Failure failure = failure_of([] { resample(noise(4, 4, 1), 0, 4); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
}

TEST(ResampleGridline, APlaneStaysThatPlaneAtAnySize) {
  // Held to the float's rounding at every sample's own place, at the borders too.
  const Heightfield plane = field_of(37, 23, [](int i, int j) { return 100 + 3.0F * i - 7.0F * j; });
  for (const auto& [w, d] : {std::pair{2, 2}, {5, 3}, {19, 12}, {36, 22}, {38, 24}, {73, 45}, {200, 7}}) {
    const Heightfield out = resample_gridline(plane, w, d);
    ASSERT_EQ(out.heights.size(), static_cast<std::size_t>(w) * d);
    EXPECT_NEAR(out.extent_x(), plane.extent_x(), 1e-3);
    EXPECT_NEAR(out.extent_z(), plane.extent_z(), 1e-3);
    for (int j = 0; j < d; ++j) {
      for (int i = 0; i < w; ++i) {
        const double x = static_cast<double>(i) * out.cell_x, z = static_cast<double>(j) * out.cell_z;
        ASSERT_NEAR(out.at(i, j), 100 + 3 * x / 10 - 7 * z / 20, 2e-4) << w << "×" << d;
      }
    }
  }
}

TEST(ResampleGridline, CoversTheWholeRectangleForAnyCell) {
  for (int n = 2; n < 400; ++n) {
    const Heightfield out = resample_gridline(test::random_ground(73, 2, 1, 0, 1, 83.3071F, 92.7665F), n, 2);
    EXPECT_GE(out.extent_x(), 72 * 83.3071F) << n;
    EXPECT_FLOAT_EQ(out.extent_x(), 72 * 83.3071F) << n;
  }
}

TEST(ResampleGridline, KeepsTheSamplesThatBothGridsHave) {
  const Heightfield field = noise(13, 9, 11, 0.2);
  const Heightfield fine = resample_gridline(field, 37, 17), back = resample_gridline(fine, 13, 9);
  EXPECT_EQ(std::memcmp(back.heights.data(), field.heights.data(), field.heights.size() * sizeof(float)), 0);
}

TEST(ResampleGridline, KeepsThePlaceOfItsSamplesOnTheEarth) {
  Heightfield field = noise(13, 9, 7);
  field.georeference.transform = {500, 10, 1, 900, 2, -20};
  const Heightfield out = resample_gridline(field, 5, 3);
  const auto place = [](const Heightfield& f, double i, double j) {
    const auto& t = f.georeference.transform;
    return std::array{t[0] + t[1] * (i + 0.5) + t[2] * (j + 0.5), t[3] + t[4] * (i + 0.5) + t[5] * (j + 0.5)};
  };
  for (const auto& [i, j] : {std::pair{0, 0}, {4, 2}, {2, 1}, {1, 2}}) {
    const auto a = place(out, i, j), b = place(field, 3 * i, 4 * j);
    EXPECT_NEAR(a[0], b[0], 1e-9);
    EXPECT_NEAR(a[1], b[1], 1e-9);
  }
}

TEST(ResampleGridline, RefusesSidesThatCannotCoverTheRectangle) {
  EXPECT_EQ(failure_of([] { resample_gridline(noise(4, 4, 1), 1, 4); }).code, ExitCode::kUsage);
  EXPECT_EQ(failure_of([] { resample_gridline(noise(4, 1, 1), 4, 2); }).code, ExitCode::kUsage);
  EXPECT_EQ(resample_gridline(noise(4, 1, 1), 7, 1).heights.size(), 7U);
}

TEST(FillNoData, KeepsDataExactlyAndStaysWithinItsBounds) {
  for (const double holes : {0.01, 0.3, 0.9, 0.999}) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      const Heightfield field = noise(67, 41, seed, holes);
      const Heightfield filled = fill_no_data(field);
      const HeightRange before = height_range(field), after = height_range(filled);
      EXPECT_EQ(after.no_data, 0U);
      EXPECT_EQ(after.lowest, before.lowest);
      EXPECT_EQ(after.highest, before.highest);
      for (std::size_t k = 0; k < field.heights.size(); ++k) {
        if (!std::isnan(field.heights[k])) {
          ASSERT_EQ(field.heights[k], filled.heights[k]);
        }
      }
    }
  }
}

TEST(FillNoData, ContinuesASmoothSurfaceIntoTheHole) {
  const auto ground = [](int i, int j) {
    return 100.0F * std::sin(0.02F * static_cast<float>(i)) +
           80.0F * std::cos(0.025F * static_cast<float>(j));
  };
  const auto in_hole = [](int i, int j) { return (i - 64) * (i - 64) + (j - 64) * (j - 64) < 20 * 20; };
  const Heightfield field =
      field_of(128, 128, [&](int i, int j) { return in_hole(i, j) ? Heightfield::kNoData : ground(i, j); });
  const Heightfield filled = fill_no_data(field);
  double error = 0, step = 0;
  int count = 0;
  for (int j = 1; j < 127; ++j) {
    for (int i = 1; i < 127; ++i) {
      if (!in_hole(i, j)) continue;
      ++count;
      error += std::pow(filled.at(i, j) - ground(i, j), 2);
      step = std::max<double>(step, std::abs(filled.at(i, j) - filled.at(i - 1, j)));
    }
  }
  // The surface spans 60 m across the hole and its steepest step is 2 m: a plug at the mean height would fail
  // both.
  EXPECT_LT(std::sqrt(error / count), 6);
  EXPECT_LT(step, 6);
}

TEST(FillNoData, LeavesFullFieldsAndWorksOnDegenerateSizes) {
  const Heightfield full = noise(5, 5, 8);
  EXPECT_EQ(fill_no_data(full).heights, full.heights);
  const Heightfield row = field_of(9, 1, [](int i, int) { return i == 0 ? 4.0F : Heightfield::kNoData; });
  EXPECT_THAT(fill_no_data(row).heights, testing::Each(4.0F));
  const Heightfield column = field_of(1, 4, [](int, int j) { return j == 3 ? 4.0F : Heightfield::kNoData; });
  EXPECT_THAT(fill_no_data(column).heights, testing::Each(4.0F));
}

TEST(FillNoData, RefusesAFieldWithoutData) {
  for (const int size : {1, 2, 13}) {
    const Failure failure =
        failure_of([&] { fill_no_data(field_of(size, 3, [](int, int) { return Heightfield::kNoData; })); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput);
    EXPECT_THAT(failure.what, HasSubstr("no sample holds a height"));
  }
}

TEST(Heightfield, ResultsDoNotDependOnTheNumberOfThreads) {
  const Heightfield field = noise(701, 503, 9, 0.2);
  const auto bits = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return checksum(fill_no_data(field)) + checksum(resample(field, 333, 1001)) +
           checksum(resample(field, 99, 77)) + checksum(crop(field, 5, 6, 600, 400)) +
           std::to_string(height_range(field).lowest);
  };
  const std::string one = bits(1);
  EXPECT_EQ(one, bits(2));
  EXPECT_EQ(one, bits(7));
}

}  // namespace
}  // namespace terrabench
