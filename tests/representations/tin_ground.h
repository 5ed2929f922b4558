// Ground for TINs, and what their triangulations are compared by.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "representations/tin/tin.h"

namespace terrabench::test {

using tin::Delaunay;
using tin::Sample;
using tin::Triangle;

inline Heightfield hills(int width, int depth) {
  Heightfield field = Heightfield::zeros(width, depth, 10, 20);
  for (int j = 0; j < depth; ++j) {
    for (int i = 0; i < width; ++i) {
      field.at(i, j) = static_cast<float>(300 * std::sin(0.11 * i) * std::cos(0.07 * j) +
                                          40 * std::sin(0.9 * i + 0.4 * j));
    }
  }
  return field;
}

inline std::unique_ptr<Tin> build_tin(const Heightfield& field, double max_error) {
  Parameters parameters(Tin::parameters());
  parameters.set("max_error", max_error);
  Progress progress;
  auto built = Tin::build(source_of("test", field), parameters, progress);
  return std::unique_ptr<Tin>(static_cast<Tin*>(built.release()));
}

inline std::set<std::array<std::pair<int, int>, 3>> corners(const Delaunay& surface) {
  std::set<std::array<std::pair<int, int>, 3>> all;
  for (const Triangle& t : surface.triangles()) {
    std::array<std::pair<int, int>, 3> at;
    for (int k = 0; k < 3; ++k)
      at[static_cast<std::size_t>(k)] = {surface.vertex(t, k).j, surface.vertex(t, k).i};
    std::ranges::sort(at);
    all.insert(at);
  }
  return all;
}

inline Delaunay triangulated(int width, int depth, const std::vector<Sample>& samples) {
  Delaunay surface(width, depth);
  std::vector<std::uint32_t> changed;
  for (const Sample s : samples) surface.insert(s, surface.locate(s, 0), changed);
  return surface;
}

inline std::vector<Sample> some_samples(int side, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    samples.push_back({static_cast<std::uint16_t>(random() % static_cast<unsigned>(side)),
                       static_cast<std::uint16_t>(random() % static_cast<unsigned>(side))});
  }
  return samples;
}

}  // namespace terrabench::test
