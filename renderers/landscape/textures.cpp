#include "renderers/landscape/textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include "terrain/sources/noise/graph.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

using noise::Graph;
using noise::Node;
using noise::Program;

// Values of a plane of noise over [0, 2)², as four shifted copies of a square whose weights are 0 at the
// border where the copy is cut: the square wraps around. Dividing by the weights' length keeps the contrast
// of the noise everywhere (plain averages are flat in the middle).
Texels seamless(const Program& program, int side) {
  Texels texels{side, side, 1, std::vector<float>(static_cast<std::size_t>(side) * side)};
  const std::size_t twice = 2 * static_cast<std::size_t>(side);
  std::vector<float> plane(twice * twice);
  const float step = 1.0F / static_cast<float>(side);
  tbb::parallel_for(std::size_t{0}, twice, [&](std::size_t row) {
    std::vector<float> x(twice), y(twice, 0.0F), z(twice, static_cast<float>(row) * step);
    for (std::size_t i = 0; i < twice; ++i) x[i] = static_cast<float>(i) * step;
    program.points(x, y, z, std::span(plane).subspan(row * twice, twice));
  });
  const double mean = std::accumulate(plane.begin(), plane.end(), 0.0) / static_cast<double>(plane.size());
  tbb::parallel_for(0, side, [&](int row) {
    const float v = static_cast<float>(row) * step;
    for (int i = 0; i < side; ++i) {
      const float u = static_cast<float>(i) * step;
      const float weights[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
      const std::size_t at = static_cast<std::size_t>(row) * twice + i;
      const std::size_t places[4] = {at + side * (twice + 1), at + side * twice, at + side, at};
      float sum = 0, squares = 0;
      for (int k = 0; k < 4; ++k) {
        sum += weights[k] * (plane[places[k]] - static_cast<float>(mean));
        squares += weights[k] * weights[k];
      }
      texels.values[static_cast<std::size_t>(row) * side + i] =
          static_cast<float>(mean) + sum / std::sqrt(squares);
    }
  });
  return texels;
}

Texels seamless(const Graph& graph, Node root, int side) { return seamless(Program(graph, root), side); }

// Replaces each value by the share of values below it. O(n log n).
void equalise(std::vector<float>& values) {
  std::vector<std::uint32_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
  const float last = static_cast<float>(std::max<std::size_t>(values.size() - 1, 1));
  // Equal values get the same share, that of the first.
  std::vector<float> shares(values.size());
  std::size_t first = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (values[order[k]] != values[order[first]]) first = k;
    shares[order[k]] = static_cast<float>(first) / last;
  }
  values = std::move(shares);
}

// Maps the mean to 0.5 and four standard deviations to 0…1.
void normalise(std::vector<float>& values) {
  double sum = 0, squares = 0;
  for (const float value : values) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const double n = static_cast<double>(values.size()), mean = sum / n;
  const double deviation = std::sqrt(std::max(squares / n - mean * mean, 1e-12));
  for (float& value : values) {
    value = std::clamp(static_cast<float>(0.5 + (value - mean) / (4 * deviation)), 0.0F, 1.0F);
  }
}

// The slope along u (axis 0) or v of a map that wraps around and is one wide.
float slope(const Texels& map, int x, int y, int axis) {
  const int side = map.width, before = side - 1;
  const float difference = axis == 0 ? map.at((x + 1) % side, y) - map.at((x + before) % side, y)
                                     : map.at(x, (y + 1) % side) - map.at(x, (y + before) % side);
  return 0.5F * static_cast<float>(side) * difference;
}

float steepest(const Texels& map) {
  float most = 1e-12F;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x)
      most = std::max(most, std::hypot(slope(map, x, y, 0), slope(map, x, y, 1)));
  }
  return most;
}

// The heights of a material's bumps; `graph` receives its nodes.
Node material_noise(Graph& g, int material, std::uint64_t seed) {
  const auto fbm = [&](float frequency, int octaves, float gain, std::uint64_t which) {
    return g.fbm({.seed = seed + which, .frequency = frequency, .octaves = octaves, .gain = gain});
  };
  const auto ridges = [&](float frequency, int octaves, float gain, std::uint64_t which) {
    return g.ridged_multifractal(
        {.seed = seed + which, .frequency = frequency, .octaves = octaves, .gain = gain});
  };
  switch (material) {
    case 0:  // sand: ripples and grain
      return g.add(g.scale_domain(
                       g.translate_domain(ridges(3, 2, 0.4F, 1), g.scale_offset(fbm(4, 3, 0.5F, 2), 0.2F, 0)),
                       1, 1, 3),
                   g.scale_offset(fbm(24, 4, 0.7F, 3), 0.8F, 0));
    case 1:  // grass: tufts
      return g.add(
          fbm(10, 6, 0.72F, 1),
          g.scale_offset(g.billow({.seed = seed + 2, .frequency = 18, .octaves = 3, .gain = 0.6F}), 0.5F, 0));
    case 2:  // earth: clods
      return g.add(
          g.scale_offset(g.billow({.seed = seed + 1, .frequency = 9, .octaves = 5, .gain = 0.6F}), 0.7F, 0),
          fbm(4, 6, 0.6F, 2));
    case 3:  // rock: cracks through layers
      return g.add(g.scale_offset(g.translate_domain(ridges(7, 6, 0.6F, 1),
                                                     g.scale_offset(fbm(5, 4, 0.5F, 2), 0.15F, 0)),
                                  -0.9F, 0),
                   fbm(11, 7, 0.68F, 3));
    default:  // snow: soft drifts
      return g.add(fbm(3, 5, 0.45F, 1), g.scale_offset(fbm(40, 3, 0.6F, 2), 0.15F, 0));
  }
}

}  // namespace

Texels sky_noise(int width, int height, std::uint64_t seed, float size) {
  Graph graph;
  // A slow fractal moves the samples of a finer one, which frays the clouds' edges.
  const Node shift = graph.fbm({.seed = seed * 8 + 1, .frequency = 1.1F, .octaves = 3});
  const Node base = graph.fbm({.seed = seed * 8 + 2, .frequency = 0.9F, .octaves = 8, .gain = 0.52F});
  const Program program(graph, graph.translate_domain(base, graph.scale_offset(shift, 0.35F, 0)));
  Texels texels{width, height, 1, std::vector<float>(static_cast<std::size_t>(width) * height)};
  tbb::parallel_for(0, height, [&](int row) {
    std::vector<float> x(width), y(width), z(width);
    // Texel centres along u; along v the first row is the zenith and the last the horizon.
    const double zenith = 0.5 * std::numbers::pi * row / (height - 1);
    // The share of the way that the sight line goes to a flat layer of clouds; a sphere would give 1.
    const double stretch = 1 / (std::cos(zenith) + 0.22);
    for (int i = 0; i < width; ++i) {
      const double azimuth = 2 * std::numbers::pi * (i + 0.5) / width;
      const double along = stretch / size;
      x[i] = static_cast<float>(along * std::sin(zenith) * std::sin(azimuth));
      y[i] = static_cast<float>(along * std::cos(zenith));
      z[i] = static_cast<float>(-along * std::sin(zenith) * std::cos(azimuth));
    }
    program.points(x, y, z, std::span(texels.values).subspan(static_cast<std::size_t>(row) * width, width));
  });
  equalise(texels.values);
  return texels;
}

Texels wave_map(int side, std::uint64_t seed) {
  const auto waves = [&](std::uint64_t which, float frequency, int octaves) {
    Graph graph;
    const Node node =
        graph.fbm({.seed = seed * 8 + which, .frequency = frequency, .octaves = octaves, .gain = 0.5F});
    return seamless(graph, node, side);
  };
  const Texels warp = waves(3, 6, 3), height = waves(4, 7, 5);
  const float most_warp = steepest(warp), most_slope = steepest(height);
  Texels map{side, side, 4, std::vector<float>(4 * static_cast<std::size_t>(side) * side)};
  tbb::parallel_for(0, side, [&](int y) {
    float* out = &map.values[4 * static_cast<std::size_t>(y) * side];
    for (int x = 0; x < side; ++x, out += 4) {
      for (int axis = 0; axis < 2; ++axis) {
        out[axis] = slope(warp, x, y, axis) / most_warp;
        out[2 + axis] = slope(height, x, y, axis) / most_slope;
      }
    }
  });
  return map;
}

Texels material_map(int material, int side, std::uint64_t seed) {
  const std::uint64_t own = (seed * 8 + static_cast<std::uint64_t>(material)) * 16 + 1000;
  Graph graph;
  const Node node = material_noise(graph, material, own);
  Texels height = seamless(graph, node, side);
  Graph wide;
  Texels patches = seamless(wide, wide.fbm({.seed = own + 9, .frequency = 3, .octaves = 5}), side);
  normalise(height.values);
  normalise(patches.values);
  Texels map{side, side, 4, std::vector<float>(4 * static_cast<std::size_t>(side) * side)};
  // Slopes are stored in eight bits: this many levels of height per texture width fill the range.
  constexpr float kSlopes = 1.0F / 60;
  tbb::parallel_for(0, side, [&](int y) {
    float* out = &map.values[4 * static_cast<std::size_t>(y) * side];
    for (int x = 0; x < side; ++x, out += 4) {
      out[0] = height.at(x, y);
      for (int axis = 0; axis < 2; ++axis) {
        out[1 + axis] = std::clamp(0.5F + 0.5F * kSlopes * slope(height, x, y, axis), 0.0F, 1.0F);
      }
      out[3] = patches.at(x, y);
    }
  });
  return map;
}

}  // namespace terrabench
