// The noise itself: values, bounds, statistics, and what odd coordinates do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "terrain/sources/noise/code.h"
#include "terrain/sources/noise/program.h"
#include "tests/terrain/noise_reference.h"

namespace terrabench::noise {
namespace {

struct Points {
  std::vector<float> x, y, z;
  void push(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
};

// Points spread evenly over a cube (a rank-1 lattice of three irrational steps).
Points spread(int count, float low, float high) {
  Points points;
  const auto at = [&](int i, double step) {
    const double turn = i * step;
    return low + static_cast<float>(turn - std::floor(turn)) * (high - low);
  };
  for (int i = 0; i < count; ++i) {
    points.push(at(i, 0.8191725133961645), at(i, 0.6710436067037893), at(i, 0.5497004779019703));
  }
  return points;
}

std::vector<float> evaluate(const Program& program, const Points& p) {
  std::vector<float> values(p.x.size());
  program.points(p.x, p.y, p.z, values);
  return values;
}

Program single(Kind kind, const Fractal& fractal) {
  Graph g;
  const Node node = kind == Kind::kFbm      ? g.fbm(fractal)
                    : kind == Kind::kBillow ? g.billow(fractal)
                                            : g.ridged_multifractal(fractal);
  return {g, node};
}

struct Moments {
  double mean = 0, deviation = 0;
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
};

Moments moments(const std::vector<float>& values) {
  Moments m;
  for (const float v : values) {
    m.mean += v;
    m.deviation += static_cast<double>(v) * v;
    m.low = std::min(m.low, v);
    m.high = std::max(m.high, v);
  }
  m.mean /= static_cast<double>(values.size());
  m.deviation = std::sqrt(m.deviation / static_cast<double>(values.size()) - m.mean * m.mean);
  return m;
}

// One octave, evaluated through the compiler, with the octave that the compiler drew from the seed.
TEST(NoiseValues, OneOctaveEqualsTheScalarReferenceBitForBit) {
  const Fractal fractal{.seed = 99, .frequency = 0.37F, .octaves = 1};
  Graph g;
  const Node node = g.fbm(fractal);
  const Octave octave = octaves(fractal).front();
  for (const float reach : {3.0F, 1000.0F, 1e7F}) {
    const Points p = spread(2000, -reach, reach);
    const std::vector<float> values = evaluate(Program(g, node), p);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float noise = reference::gradient_noise(p.x[i] * octave.frequency + octave.offset_x,
                                                    p.y[i] * octave.frequency + octave.offset_y,
                                                    p.z[i] * octave.frequency + octave.offset_z, octave.seed);
      ASSERT_EQ(values[i], noise * octave.weight) << p.x[i] << ' ' << p.y[i] << ' ' << p.z[i];
    }
  }
}

TEST(NoiseValues, VanishesAtLatticePoints) {
  const Fractal fractal{.seed = 5, .octaves = 1};
  const Octave octave = octaves(fractal).front();
  Points p;
  for (int i = -40; i < 40; ++i) {
    p.push(static_cast<float>(i) - octave.offset_x, static_cast<float>(3 * i) - octave.offset_y,
           static_cast<float>(i * i) - octave.offset_z);
  }
  for (const float v : evaluate(single(Kind::kFbm, fractal), p)) EXPECT_EQ(v, 0.0F);
}

// Across the faces of cells, too, a small step changes the value by no more than slope times step.
TEST(NoiseValues, IsContinuous) {
  const Program program = single(Kind::kFbm, {.seed = 8, .octaves = 1});
  constexpr float kStep = 1.0F / 256;
  for (int axis = 0; axis < 3; ++axis) {
    Points p;
    for (int i = 0; i < 20000; ++i) {
      const float t = static_cast<float>(i) * kStep - 30.0F;
      p.push(axis == 0 ? t : 0.3F, axis == 1 ? t : -7.6F, axis == 2 ? t : 11.2F);
    }
    const std::vector<float> values = evaluate(program, p);
    for (std::size_t i = 1; i < values.size(); ++i) ASSERT_LT(std::abs(values[i] - values[i - 1]), 4 * kStep);
  }
}

TEST(NoiseValues, KeepTheirRangesAndFbmAveragesZero) {
  const Points p = spread(200000, -5000, 5000);
  const Moments fbm = moments(evaluate(single(Kind::kFbm, {.seed = 1, .octaves = 1}), p));
  EXPECT_GE(fbm.low, -1.0F);
  EXPECT_LE(fbm.high, 1.0F);
  EXPECT_LT(fbm.low, -0.8F);  // the range is used, not only kept
  EXPECT_GT(fbm.high, 0.8F);
  EXPECT_NEAR(fbm.mean, 0, 0.003);
  EXPECT_NEAR(fbm.deviation, 0.26, 0.03);
  const Moments six = moments(evaluate(single(Kind::kFbm, {.seed = 2}), p));
  EXPECT_NEAR(six.mean, 0, 0.003);
  const Moments ridged = moments(evaluate(single(Kind::kRidgedMultifractal, {.seed = 1}), p));
  EXPECT_GE(ridged.low, 0.0F);
  EXPECT_LE(ridged.high, 1.0F);
  EXPECT_GT(ridged.high, 0.95F);
  const Moments billow = moments(evaluate(single(Kind::kBillow, {.seed = 1}), p));
  EXPECT_GE(billow.low, -1.0F);
  EXPECT_LE(billow.high, 1.0F);
}

// Independent octaves add their variances: deviation² of the sum is Σ wᵢ² of one octave's.
TEST(NoiseValues, OctavesAddAsIndependentNoiseDoes) {
  const Points p = spread(200000, -5000, 5000);
  const double one = moments(evaluate(single(Kind::kFbm, {.seed = 4, .octaves = 1}), p)).deviation;
  double squares = 0, sum = 0;
  for (int i = 0; i < 6; ++i) {
    squares += std::pow(0.25, i);
    sum += std::pow(0.5, i);
  }
  const double six = moments(evaluate(single(Kind::kFbm, {.seed = 4}), p)).deviation;
  EXPECT_NEAR(six, one * std::sqrt(squares) / sum, 0.01);
}

// Along each axis the power of one octave lies round its own frequency: little below a quarter of it, little
// above four times.
TEST(NoiseValues, PowerLiesAroundTheFrequencyAlongEveryAxis) {
  const Program program = single(Kind::kFbm, {.seed = 21, .octaves = 1});
  constexpr int kCount = 1024, kLines = 32;
  std::array<double, 3> within{};
  for (int axis = 0; axis < 3; ++axis) {
    double inside = 0, all = 0;
    for (int line = 0; line < kLines; ++line) {
      Points p;
      for (int i = 0; i < kCount; ++i) {
        const float t = static_cast<float>(i) / 16, o = static_cast<float>(line) * 7.37F;
        p.push(axis == 0 ? t : o, axis == 1 ? t : o + 0.41F, axis == 2 ? t : o + 0.77F);
      }
      const std::vector<float> v = evaluate(program, p);
      // 64 cells per line: harmonic h has h/64 cycles per cell.
      for (int h = 1; h < 320; ++h) {
        double re = 0, im = 0;
        for (int i = 0; i < kCount; ++i) {
          const double angle = 2 * std::numbers::pi * h * i / kCount;
          re += v[static_cast<std::size_t>(i)] * std::cos(angle);
          im += v[static_cast<std::size_t>(i)] * std::sin(angle);
        }
        const double power = re * re + im * im;
        all += power;
        if (h >= 8 && h <= 128) inside += power;
      }
    }
    within[static_cast<std::size_t>(axis)] = inside / all;
    EXPECT_GT(inside / all, 0.7) << "axis " << axis;
  }
  EXPECT_NEAR(within[0], within[1], 0.08);
  EXPECT_NEAR(within[0], within[2], 0.08);
}

// No direction is rougher than another: mean squared differences over half a cell agree along the axes and
// diagonals.
TEST(NoiseValues, IsAsRoughInEveryDirection) {
  const Program program = single(Kind::kFbm, {.seed = 33, .octaves = 1});
  const Points p = spread(100000, -3000, 3000);
  const std::vector<float> here = evaluate(program, p);
  const float diagonal = 0.5F / std::numbers::sqrt2_v<float>;
  const std::array<std::array<float, 3>, 6> steps = {{{0.5F, 0, 0},
                                                      {0, 0.5F, 0},
                                                      {0, 0, 0.5F},
                                                      {diagonal, diagonal, 0},
                                                      {0, diagonal, -diagonal},
                                                      {diagonal, 0, diagonal}}};
  std::vector<double> roughness;
  for (const auto& step : steps) {
    Points q = p;
    for (std::size_t i = 0; i < q.x.size(); ++i) {
      q.x[i] += step[0];
      q.y[i] += step[1];
      q.z[i] += step[2];
    }
    const std::vector<float> there = evaluate(program, q);
    double sum = 0;
    for (std::size_t i = 0; i < here.size(); ++i) sum += std::pow(there[i] - here[i], 2);
    roughness.push_back(sum / static_cast<double>(here.size()));
  }
  for (const double r : roughness) EXPECT_NEAR(r / roughness[0], 1.0, 0.06);
}

// Neighbouring lattice points draw independent gradients, also for small coordinates and small seeds.
TEST(NoiseValues, GradientsOfNeighboursAreIndependent) {
  for (const std::uint32_t seed : {0U, 1U, 0xDEADBEEFU}) {
    std::array<int, 27> seen{};
    std::array<double, 3> along{};
    constexpr std::uint32_t kSide = 64;
    for (std::uint32_t z = 0; z < kSide; ++z) {
      for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
          const auto g = reference::direction(reference::hash(x - 32, y - 32, z - 32, seed));
          ++seen[static_cast<std::size_t>((g[0] + 1) * 9 + (g[1] + 1) * 3 + g[2] + 1)];
          const std::uint32_t next[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto n = reference::direction(reference::hash(
                x - 32 + next[axis][0], y - 32 + next[axis][1], z - 32 + next[axis][2], seed));
            along[axis] += g[0] * n[0] + g[1] * n[1] + g[2] * n[2];
          }
        }
      }
    }
    constexpr double kAll = kSide * kSide * kSide;
    int directions = 0;
    for (const int count : seen) {
      if (count == 0) continue;
      ++directions;
      EXPECT_NEAR(count / kAll, 1.0 / 12, 0.004);
    }
    EXPECT_EQ(directions, 12);
    for (const double sum : along) EXPECT_NEAR(sum / kAll, 0, 0.012) << "seed " << seed;
  }
}

TEST(NoiseValues, SeedsAndOctavesDiffer) {
  const Points p = spread(5000, -100, 100);
  const std::vector<float> a = evaluate(single(Kind::kFbm, {.seed = 1}), p);
  const std::vector<float> b = evaluate(single(Kind::kFbm, {.seed = 2}), p);
  double product = 0, squared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product += a[i] * b[i];
    squared += a[i] * a[i];
  }
  EXPECT_LT(std::abs(product / squared), 0.08);
  EXPECT_EQ(a, evaluate(single(Kind::kFbm, {.seed = 1}), p));
}

TEST(NoiseValues, OddCoordinatesGiveFiniteNoise) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Points p;
  for (const float odd : {kNan, kInf, -kInf, 3e38F, -3e38F, 2e9F, -2e9F, 1e-40F, -0.0F, 16777216.0F}) {
    p.push(odd, 0.3F, 0.6F);
    p.push(0.3F, odd, 0.6F);
    p.push(odd, odd, odd);
  }
  for (const Kind kind : {Kind::kFbm, Kind::kRidgedMultifractal, Kind::kBillow}) {
    const Program program = single(kind, {.seed = 6});
    for (const float v : evaluate(program, p)) EXPECT_LE(std::abs(v), 1.0F);
    for (const float odd : p.x) {
      std::vector<float> column(70);
      program.column({odd, 1.0F, odd, 0.5F}, column);
      program.column({1.0F, 1.0F, 2.0F, odd}, column);
      for (const float v : column) EXPECT_LE(std::abs(v), 1.0F);
    }
  }
}

}  // namespace
}  // namespace terrabench::noise
