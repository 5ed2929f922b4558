// The grounds that tests build from: a formula, or random heights by seed, with or without holes.
#pragma once

#include <cmath>
#include <random>

#include "terrain/heightfield.h"

namespace terrabench::test {

// height(i, j) at each sample, asked row by row.
template <class HeightOf>
Heightfield ground_of(int width, int depth, const HeightOf& height, float cell_x = 1, float cell_z = 1) {
  Heightfield field{width, depth, cell_x, cell_z, {}, {}};
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) field.heights.push_back(static_cast<float>(height(i, j)));
  }
  return field;
}

inline Heightfield flat(int width, int depth, float height = 0) {
  return ground_of(width, depth, [=](int, int) { return height; });
}

// Independent heights in [low, high).
inline Heightfield random_ground(int width, int depth, unsigned seed, float low, float high, float cell_x = 1,
                                 float cell_z = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> heights(low, high);
  return ground_of(
      width, depth, [&](int, int) { return heights(random); }, cell_x, cell_z);
}

inline Heightfield rounded(Heightfield field) {  // to whole metres
  for (float& h : field.heights) h = std::round(h);
  return field;
}

// Each sample is a hole with this probability.
inline Heightfield with_holes(Heightfield field, unsigned seed, double share) {
  std::mt19937 random(seed);
  std::bernoulli_distribution hole(share);
  for (float& h : field.heights) h = hole(random) ? Heightfield::kNoData : h;
  return field;
}

// Smooth: about seven samples per radian, up to `height` above and below 0.
inline Heightfield waves(int width, int depth, float height, float cell_x = 1, float cell_z = 1) {
  const auto wave = [=](int i, int j) {
    return height * std::sin(0.15F * static_cast<float>(i)) * std::cos(0.11F * static_cast<float>(j));
  };
  return ground_of(width, depth, wave, cell_x, cell_z);
}

// Waves of several lengths, with noise of `noise` metres.
inline Heightfield hilly(int width, int depth, float noise = 0, unsigned seed = 1, float cell_x = 1,
                         float cell_z = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> spread(-noise, noise);
  const auto hill = [&](int i, int j) {
    const auto x = static_cast<float>(i), z = static_cast<float>(j);
    return 12 * std::sin(0.05F * x) * std::cos(0.07F * z) + 2 * std::sin(0.31F * x + 0.2F * z) +
           spread(random);
  };
  return ground_of(width, depth, hill, cell_x, cell_z);
}

// Rough hills of 270 to 730 m, of whole metres or not, with a share of holes; cells of 30 m × 25 m. Seeds
// differ in the hills too.
inline Heightfield hills(int width, int depth, unsigned seed, bool whole = false,
                         unsigned percent_holes = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  const float a = unit(random), b = unit(random), c = unit(random);
  const auto hill = [&](int i, int j) {
    const auto x = static_cast<float>(i), z = static_cast<float>(j);
    const float h = 500 + 150 * std::sin(0.11F * x + 6 * a) * std::cos(0.09F * z + 6 * b) +
                    60 * std::sin(0.31F * x - 0.23F * z + 6 * c) + 20 * unit(random);
    return random() % 100 < percent_holes ? Heightfield::kNoData : h;
  };
  const Heightfield field = ground_of(width, depth, hill, 30, 25);
  return whole ? rounded(field) : field;
}

}  // namespace terrabench::test
