// Differences of representations from ground with known answers.
#include "experiments/cross/representations/ground_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace terrabench::cross {
namespace {

// 64 m cubed. Solid up to 24 m; a roof from 40 to 48 m over the western half.
TerrainSource overhanging() {
  TerrainSource source;
  source.name = "overhanging";
  source.solid = Solid{
      {{0, 0, 0}, {64, 64, 64}}, std::string(32, '0'), [](const ColumnSamples& at, std::span<Material> out) {
        for (std::size_t k = 0; k < out.size(); ++k) {
          const float y = at.y0 + static_cast<float>(k) * at.dy;
          const bool roof = at.x < 32 && y >= 40 && y < 48;
          out[k] = y < 24 || roof ? Material::kBedrock : Material::kAir;
        }
      }};
  return source;
}

std::unique_ptr<Representation> build(std::string_view name, const TerrainSource& source,
                                      std::int64_t resolution) {
  Progress progress;
  const RepresentationType& type = representation(name);
  Parameters parameters(type.parameters);
  parameters.set("resolution", resolution);
  return type.build(source, parameters, progress);
}

Differences between(std::string_view name, const TerrainSource& source, std::int64_t resolution = 0) {
  return differences(*build(name, source, resolution), source, ground_lines(source, 16), 4);
}

TEST(GroundLines, LengthsOfPartsAreExact) {
  const std::vector<Part> a = {{0, 2}, {3, 8}}, b = {{1, 4}, {5, 6}, {7, 20}};
  EXPECT_EQ(overlap(a, b), 1 + 1 + 1 + 1);
  EXPECT_EQ(overlap(b, a), overlap(a, b));
  EXPECT_EQ(overlap(a, {}), 0);
  const std::vector<Part> left = without(a, b, 0.25F);
  ASSERT_EQ(left.size(), 3U);  // of [0, 2] and [3, 8]
  EXPECT_EQ(left[0].bottom, 0);
  EXPECT_EQ(left[0].top, 0.75F);
  EXPECT_EQ(left[1].bottom, 4.25F);
  EXPECT_EQ(left[1].top, 4.75F);
  EXPECT_EQ(left[2].bottom, 6.25F);
  EXPECT_EQ(left[2].top, 6.75F);
}

TEST(GroundLines, RandomLinesLieInTheirSquaresAndOnNoGrid) {
  const TerrainSource source = overhanging();
  const GroundLines lines = random_lines(source, 16, 1), middles = ground_lines(source, 16);
  ASSERT_EQ(lines.x.size(), 16U * 16);
  double moved = 0;
  for (std::size_t c = 0; c < lines.x.size(); ++c) {
    EXPECT_LT(std::abs(lines.x[c] - middles.x[c]), 2);
    EXPECT_LT(std::abs(lines.z[c] - middles.z[c]), 2);
    moved += std::abs(lines.x[c] - middles.x[c]) + std::abs(lines.z[c] - middles.z[c]);
  }
  EXPECT_NEAR(moved / 512, 1, 0.15);  // half of the farthest
}

TEST(GroundLines, VolumesAndTheAirUnderOverhangsHaveErrorsOfTheirOwn) {
  const TerrainSource source = overhanging();
  const GroundLines lines = random_lines(source, 16, 1);
  const VolumeErrors exact = volume_errors(*build("layered_stack", source, 64), lines);
  EXPECT_EQ(exact.volume, 0);
  EXPECT_EQ(exact.air, 0);
  // Under the roof, 16 of 64 m are air, and 24 + 8 m solid; elsewhere 24 m are.
  const VolumeErrors filled = volume_errors(*build("heightmap", source, 64), lines);
  EXPECT_NEAR(filled.volume, 16.0 / (24 + 8 + 16 + 24), 0.01);
  EXPECT_EQ(filled.air, 1);
}

// A floor at a third of a sample's distance from where samples lie.
TEST(GroundLines, EndsLieBetweenSamples) {
  TerrainSource source = overhanging();
  source.solid->column = [](const ColumnSamples& at, std::span<Material> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = at.y0 + static_cast<float>(k) * at.dy < 24.3F ? Material::kBedrock : Material::kAir;
    }
  };
  for (const Part& part : ground_lines(source, 16).parts.line(7)) {
    EXPECT_EQ(part.bottom, 0);
    EXPECT_NEAR(part.top, 24.3, 0.5 / 16);
  }
}

TEST(GroundLines, AStructureOnTheGridIsExact) {
  const Differences found = between("layered_stack", overhanging(), 64);
  EXPECT_EQ(found.rmse, 0);
  EXPECT_EQ(found.largest, 0);
  EXPECT_EQ(found.lost_columns, 0U);
  EXPECT_EQ(found.volume_iou, 1);
  EXPECT_EQ(found.distance->hausdorff(), 0);
  EXPECT_EQ(found.cavities, 32.0 * 64 * 16);
  EXPECT_EQ(found.cavities_filled, 0);
  // Lines stand 4 m apart; the cavity is 16 m high, of which a margin of 4 m leaves 8. The last column of
  // lines under the roof is next to one without, above which there is nothing solid that is near.
  EXPECT_EQ(found.cores, 32.0 * 64 * 8);
  EXPECT_EQ(found.cores_filled, 0);
}

TEST(GroundLines, HeightsFillWhatIsUnderARoof) {
  const Differences found = between("heightmap", overhanging(), 64);
  EXPECT_EQ(found.rmse, 0);
  EXPECT_EQ(found.cavities_filled, found.cavities);
  EXPECT_EQ(found.cores_filled, found.cores);
  const double ground = 64.0 * 64 * 24 + 32.0 * 64 * 8, filled = 32.0 * 64 * 16;
  EXPECT_NEAR(*found.volume_iou, ground / (ground + filled), 1e-6);
  EXPECT_EQ(found.distance->from_ground, 24);  // from the ground under the roof to the roof's upper side
  // The new wall's points stand on the last line under the roof, 2 m west of it, at multiples of 4 m: the
  // middle one is 8 m from the ground and from the roof's lower side.
  EXPECT_EQ(found.distance->to_ground, 8);
  EXPECT_EQ(found.distance->hausdorff(), 24);
}

TEST(GroundLines, HeightsAreComparedSampleBySample) {
  Heightfield field = Heightfield::zeros(33, 33, 2, 2);
  for (int j = 0; j < 33; ++j) {
    for (int i = 0; i < 33; ++i) field.at(i, j) = static_cast<float>(i);
  }
  const TerrainSource source = source_of("slope", field);
  for (float& h : field.heights) h += 1;
  field.at(7, 5) += 10;
  field.at(9, 9) = Heightfield::kNoData;
  const TerrainSource other = source_of("lifted", field);
  const auto built = build("heightmap", other, 0);
  const Differences found = differences(*built, source, ground_lines(source, 16), 4);
  EXPECT_EQ(found.columns, 33U * 33 - 1);
  EXPECT_EQ(found.lost_columns, 1U);
  EXPECT_EQ(found.largest, 11);
  EXPECT_EQ(found.p99, 1);
  EXPECT_NEAR(found.rmse, std::sqrt((33.0 * 33 - 2 + 121) / (33.0 * 33 - 1)), 1e-9);
  EXPECT_EQ(between("heightmap", source).volume_iou, 1);
  EXPECT_EQ(between("heightmap", source).distance->hausdorff(), 0);
}

// Single samples among voids stand between the lines.
TEST(GroundLines, WhatHasNothingToCompareIsNotDefined) {
  Heightfield field = Heightfield::zeros(17, 17, 2, 2);
  for (float& h : field.heights) h = Heightfield::kNoData;
  field.at(0, 0) = 1;
  field.at(16, 16) = 5;
  const Differences voids = between("heightmap", source_of("voids", field));
  EXPECT_EQ(voids.columns, 2U);
  EXPECT_FALSE(voids.distance);
  EXPECT_FALSE(voids.volume_iou);
}

}  // namespace
}  // namespace terrabench::cross
