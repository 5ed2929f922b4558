// Noise at whole points equals the graph's noise, and is exact where floats cannot hold the point.
#include "terrain/sources/noise/lattice_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/program.h"
#include "tests/terrain/noise_reference.h"

namespace terrabench::noise {
namespace {

constexpr LatticeFractal kFractal{.seed = 77, .cell_bits = 11, .octaves = 10, .gain = 0.5F};
const Fractal kGraphs{.seed = 77, .frequency = 1.0F / 2048, .octaves = 10, .gain = 0.5F};

struct Points {
  std::vector<std::int32_t> x, z;
};

Points around(std::int32_t x, std::int32_t z, int reach, int count) {
  std::mt19937 random(5);
  Points points;
  for (int k = 0; k < count; ++k) {
    const auto step = [&] { return static_cast<std::int32_t>(random() % (2 * reach)) - reach; };
    points.x.push_back(x + step());
    points.z.push_back(z + step());
  }
  return points;
}

std::vector<float> values(const Points& p) {
  std::vector<float> out(p.x.size());
  LatticeNoise(kFractal).points(p.x, p.z, out);
  return out;
}

TEST(LatticeNoise, IsTheGraphsFbmToTheBit) {
  Graph graph;
  const Node node = graph.fbm(kGraphs);
  const Points p = around(0, 0, 8000, 5001);
  std::vector<float> x(p.x.begin(), p.x.end()), y(x.size()), z(p.z.begin(), p.z.end()), expected(x.size());
  Program(graph, node).points(x, y, z, expected);
  EXPECT_EQ(values(p), expected);
}

// Cell and fraction in whole numbers of 64 bits, the noise in plain scalars.
reference::Axis axis(std::int64_t point, int bits, float offset) {
  const auto at = point * 256 + std::int64_t{static_cast<int>(offset * 256)} * (std::int64_t{1} << bits);
  const std::int64_t cell = at >> (bits + 8);
  const auto f = static_cast<float>(std::ldexp(static_cast<double>(at - (cell << (bits + 8))), -bits - 8));
  return {static_cast<std::uint32_t>(cell), {f, f - 1.0F}, {1.0F - reference::fade(f), reference::fade(f)}};
}

TEST(LatticeNoise, IsExactHoweverFarThePointLies) {
  const std::vector<Octave> octave = octaves(kGraphs);
  for (const std::int32_t far : {0, 1 << 22, -(1 << 26) - 12345, 1 << 30, -(1 << 30)}) {
    const Points p = around(far, -far / 3, 1000, 500);
    const std::vector<float> found = values(p);
    for (std::size_t k = 0; k < found.size(); ++k) {
      float expected = 0;
      for (int o = 0; o < kFractal.octaves; ++o) {
        const int bits = kFractal.cell_bits - o;
        expected += octave[o].weight * reference::gradient_noise(axis(p.x[k], bits, octave[o].offset_x),
                                                                 reference::split(octave[o].offset_y),
                                                                 axis(p.z[k], bits, octave[o].offset_z),
                                                                 octave[o].seed);
      }
      ASSERT_EQ(found[k], expected) << p.x[k] << ' ' << p.z[k];
      ASSERT_LE(std::abs(found[k]), 1.0F);
    }
  }
}

TEST(LatticeNoise, OnePointHasOneValueInAnyCompany) {
  const Points p = around(1 << 25, 1 << 24, 5000, 100);
  const std::vector<float> together = values(p);
  for (std::size_t k = 0; k < p.x.size(); ++k) EXPECT_EQ(values({{p.x[k]}, {p.z[k]}})[0], together[k]);
}

TEST(LatticeNoise, RefusesWhatIsNoFractal) {
  EXPECT_THROW(LatticeNoise({.cell_bits = 16}), Error);
  EXPECT_THROW(LatticeNoise({.cell_bits = 3, .octaves = 5}), Error);
  EXPECT_THROW(LatticeNoise({.octaves = 0}), Error);
  EXPECT_THROW(LatticeNoise({.gain = NAN}), Error);
}

}  // namespace
}  // namespace terrabench::noise
