// The numbers that the claims read from the figures of "hybrid" tell what they show from something unrelated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/hybrid/grass_measures.h"
#include "experiments/hybrid/landscape_measures.h"
#include "experiments/hybrid/stage_relations.h"
#include "terrain/mesh.h"
#include "tests/experiments/value.h"

namespace terrabench::hybrid {
namespace {

Record compared(noise::Stage stage, const Pixels& now) {
  Record record;
  Recorder recorder(record, "unused");
  Progress progress;
  compare_stages(stage, now, {.seed = 1}, recorder, progress);
  return record;
}

Pixels slice(noise::Stage stage) {
  Progress progress;
  return slice_of(stage, {.seed = 1}, 128, progress);
}

TEST(NoiseStages, OnlyTheStageItselfIsTheOneBeforeItAtMovedPlaces) {
  using enum noise::Stage;
  for (const noise::Stage stage : {kXYPerturbed, kPerturbedRidged}) {
    const Record own = compared(stage, slice(stage)), other = compared(stage, slice(kRidged));
    EXPECT_EQ(value(own, "share_off_the_shift"), 0);
    EXPECT_GT(value(other, "share_off_the_shift"), 0.5);
  }
  // A cave map of the same look, turned upside down: cells change far from any edge.
  Pixels turned = slice(kPerturbedRidged);
  std::reverse(turned.values.begin(), turned.values.end());
  const Record unrelated = compared(kPerturbedRidged, turned);
  EXPECT_GT(value(unrelated, "share_far_from_edges"), 0.05);
}

TEST(NoiseStages, HillsFollowTheNoiseAndCrestsAreSharp) {
  using enum noise::Stage;
  EXPECT_LE(value(compared(kYPerturbed, slice(kYPerturbed)), "heights_off_the_noise"), 1);
  EXPECT_GT(value(compared(kYPerturbed, slice(kXYPerturbed)), "heights_off_the_noise"), 1);
  const Record flat = compared(kYPerturbed, slice(kClampedGradient));
  EXPECT_EQ(value(flat, "relief"), 0);
  const Record ridged = compared(kRidged, slice(kRidged)), fbm = compared(kRidged, slice(kFbm));
  EXPECT_GT(value(ridged, "sharpness_of_maxima"), 2 * value(ridged, "sharpness_of_minima"));
  EXPECT_LT(value(fbm, "sharpness_of_maxima"), 2 * value(fbm, "sharpness_of_minima"));
}

TEST(NoiseStages, AttenuationLeavesAPartOfTheCavesLessOfItAbove) {
  using enum noise::Stage;
  const Record own = compared(kAttenuated, slice(kAttenuated));
  EXPECT_EQ(value(own, "caves_added"), 0);
  EXPECT_LT(value(own, "caves_left_high"), value(own, "caves_left_low"));
  const Record none = compared(kAttenuated, slice(kMultiplied));
  EXPECT_EQ(value(none, "caves_left_high"), value(none, "caves_left_low"));
}

// A slope of 45° that bends by a few degrees, with its normals.
TriangleMesh slope() {
  TriangleMesh mesh;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      mesh.positions.emplace_back(i, static_cast<float>(i) + 0.02F * static_cast<float>(i * i), j);
  }
  for (std::uint32_t j = 0; j < 2; ++j) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t a = 3 * j + i, b = a + 1, c = a + 3, d = a + 4;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  compute_normals(mesh);
  return mesh;
}

TEST(GrassFigures, UprightGuidesLeanOutOfTheFaces) {
  const TriangleMesh mesh = slope();
  std::vector<SceneLine> along, upright;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    along.push_back({.points = {mesh.positions[v], mesh.positions[v] + mesh.normals[v]}});
    upright.push_back({.points = {mesh.positions[v], mesh.positions[v] + glm::vec3(0, 1, 0)}});
  }
  EXPECT_LT(lean_out_of_faces(mesh, along), 0.01);
  EXPECT_GT(lean_out_of_faces(mesh, upright), 30);
}

TEST(GrassFigures, StrandsAlongTheFaceAreOffTheNormalsOfTheCorners) {
  TriangleMesh one;
  one.positions = {{0, 0, 4}, {5, 0, 3}, {1, 0, 0}};
  one.normals = {glm::normalize(glm::vec3(-1, 1, 1)), glm::normalize(glm::vec3(1, 1, 0)), {0, 1, 0}};
  one.indices = {0, 1, 2};
  GrassStrand strand{};
  strand.root = 0.25F * one.positions[0] + 0.25F * one.positions[1] + 0.5F * one.positions[2];
  strand.up = glm::normalize(0.25F * one.normals[0] + 0.25F * one.normals[1] + 0.5F * one.normals[2]);
  const Interpolation mean = interpolation_of(one, {strand});
  EXPECT_LT(mean.off_the_normals, 0.01);
  EXPECT_NEAR(mean.least_coordinate, 0.25, 1e-6);
  strand.up = {0, 1, 0};
  EXPECT_GT(interpolation_of(one, {strand}).off_the_normals, 1);
}

TEST(LandscapeFigures, UnrelatedChannelsAreNotSlopesOfOneHeight) {
  const Texels waves = wave_map(64, 1);
  EXPECT_LT(measure_slopes(waves, 0, 1).curl, 0.01);
  EXPECT_GT(measure_slopes(waves, 0, 3).curl, 0.5);
  Texels cut{4, 1, 1, {0, 0.1F, 0.2F, 0.3F}};
  EXPECT_GT(measure_seam(cut).at_seam, measure_seam(cut).elsewhere);
}

// Level water below the eye, mixed by `share` of the cosine of the angle with the normal.
template <class Share>
WaterMix mixed_by(const Share& share) {
  View view;
  view.width = view.height = 64;
  view.target = {0, -1, -1};
  view.vertical_fov = 1;
  const auto byte = [](double light) {
    return static_cast<std::uint8_t>(std::lround(255 * (1.055 * std::pow(light, 1 / 2.4) - 0.055)));
  };
  const double reflected = 0.6, refracted = 0.1;
  Image reflection(64, 64, {byte(reflected), byte(reflected), byte(reflected)}),
      refraction(64, 64, {byte(refracted), byte(refracted), byte(refracted)}), mixed(64, 64, {});
  const double slope = std::tan(0.5);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double up = slope * (1 - 2 * (y + 0.5) / 64), right = slope * (2 * (x + 0.5) / 64 - 1);
      const double cosine = (1 - up) / std::sqrt(2.0) / std::sqrt(1 + up * up + right * right);
      const std::uint8_t light = byte(refracted + share(cosine) * (reflected - refracted));
      mixed.set(x, y, {light, light, light});
    }
  }
  return measure_mix(reflection, refraction, mixed, view);
}

TEST(LandscapeFigures, TheMixOfWaterIsRecovered) {
  const WaterMix schlick = mixed_by([](double cosine) { return 0.02 + 0.98 * std::pow(1 - cosine, 5); });
  EXPECT_EQ(schlick.between, 1);
  EXPECT_LT(schlick.near, schlick.far);
  EXPECT_NEAR(schlick.near / schlick.near_schlick, 1, 0.05);
  EXPECT_NEAR(schlick.far / schlick.far_schlick, 1, 0.05);
  const WaterMix even = mixed_by([](double) { return 0.5; });
  EXPECT_NEAR(even.near, even.far, 0.01);
  EXPECT_EQ(mixed_by([](double) { return 1.2; }).between, 0);
}

}  // namespace
}  // namespace terrabench::hybrid
