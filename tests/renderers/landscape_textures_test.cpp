// The textures of landscapes wrap around without a seam, and the shaders compute the printed formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/landscape/probe.h"
#include "renderers/landscape/textures.h"

namespace terrabench {
namespace {

// The largest difference of neighbours along an axis: between the last and the first, and elsewhere.
struct Steps {
  double seam = 0, inside = 0;
};

Steps steps(const Texels& map, int channel, bool along_x) {
  Steps largest;
  const int length = along_x ? map.width : map.height, lines = along_x ? map.height : map.width;
  for (int line = 0; line < lines; ++line) {
    for (int k = 0; k < length; ++k) {
      const int next = (k + 1) % length;
      const double difference = std::abs(along_x ? map.at(k, line, channel) - map.at(next, line, channel)
                                                 : map.at(line, k, channel) - map.at(line, next, channel));
      double& one = next == 0 ? largest.seam : largest.inside;
      one = std::max(one, difference);
    }
  }
  return largest;
}

TEST(LandscapeTextures, WrapAround) {
  std::vector<Texels> maps{wave_map(128, 3)};
  for (int material = 0; material < 5; ++material) maps.push_back(material_map(material, 128, 3));
  for (std::size_t k = 0; k < maps.size(); ++k) {
    for (int channel = 0; channel < 4; ++channel) {
      for (const bool along_x : {true, false}) {
        const Steps found = steps(maps[k], channel, along_x);
        EXPECT_LE(found.seam, found.inside) << k << ' ' << channel;
        EXPECT_GT(found.inside, k > 0 ? 0.01 : 0);
      }
    }
  }
}

TEST(LandscapeTextures, TheSkyHasNeitherSeamNorPole) {
  const Texels map = sky_noise(512, 192, 5, 1);
  const Steps found = steps(map, 0, true);
  EXPECT_LE(found.seam, found.inside);
  for (int x = 1; x < map.width; ++x) ASSERT_EQ(map.at(x, 0), map.at(0, 0));
  // Equalised: a tenth of the sky lies in each tenth of the values.
  std::size_t low = 0;
  for (const float value : map.values) low += value < 0.1F ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(low) / static_cast<double>(map.values.size()), 0.1, 0.01);
}

TEST(LandscapeTextures, TheSeedDecides) {
  EXPECT_EQ(wave_map(32, 7).values, wave_map(32, 7).values);
  EXPECT_NE(wave_map(32, 7).values, wave_map(32, 8).values);
  EXPECT_NE(sky_noise(64, 32, 1, 1).values, sky_noise(64, 32, 1, 2).values);
}

TEST(LandscapeTextures, AMapOfOneSizeHasTheContrastOfItsNoiseEverywhere) {
  const Texels map = material_map(1, 256, 2);
  const auto deviation = [&](int x0, int y0) {
    double sum = 0, squares = 0;
    for (int y = y0; y < y0 + 64; ++y) {
      for (int x = x0; x < x0 + 64; ++x) {
        sum += map.at(x, y);
        squares += std::pow(map.at(x, y), 2);
      }
    }
    return std::sqrt(squares / 4096 - std::pow(sum / 4096, 2));
  };
  // The middle is where four copies are mixed in equal parts, the corner one copy alone.
  EXPECT_NEAR(deviation(96, 96) / deviation(0, 0), 1, 0.35);
}

TEST(Probe, ComputesThePrintedFormulas) {
  const auto context = open_context("osmesa", 16, 16);
  const glm::vec4 sky[] = {{0, 0, 0, 0}, {0.25F, 0, 0, 0}, {0.5F, 0, 0, 0}, {1, 0, 0, 0}};
  const std::vector<float> shares = evaluate(*context, Probe::kSkyShare, sky);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    EXPECT_NEAR(shares[k], (std::cos(sky[k].x * std::numbers::pi) + 1) / 2, 1e-6);
  }
  // (1 - cos 60°)^5 of 0.98, above 0.02; the sun's reading sees only the sun's height.
  const float sixty = std::numbers::pi_v<float> / 3;
  const glm::vec4 water[] = {{sixty, 0.5F, 1, 0}, {sixty, 0.5F, 1, 1}, {sixty, 0.5F, 1, 2}, {0, 0.5F, 2, 2}};
  const std::vector<float> reflected = evaluate(*context, Probe::kReflectance, water);
  EXPECT_NEAR(reflected[0], 0.02 + 0.98 / 32, 1e-5);
  EXPECT_NEAR(reflected[1], reflected[0], 1e-5);
  EXPECT_NEAR(reflected[2], 0.02 + 0.98 * std::pow(1 - std::sin(0.5), 5), 1e-5);
  EXPECT_EQ(reflected[2], reflected[3]);
  const glm::vec4 slopes[] = {{0.5F, 0, 0, 0}, {0.5F, 1, 0, 0}};
  EXPECT_NEAR(evaluate(*context, Probe::kSlope, slopes)[0], 60, 0.01);  // GPUs approximate acos
  EXPECT_NEAR(evaluate(*context, Probe::kSlope, slopes)[1], 45, 1e-4);
}

}  // namespace
}  // namespace terrabench
