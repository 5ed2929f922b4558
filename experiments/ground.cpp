#include "experiments/ground.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

constexpr float kFrequency = 1.0F / 4000;  // of the first octave: a third of the drill paper's ground

}  // namespace

std::vector<std::string> grounds(const RunOptions& options, std::vector<std::string> own) {
  return options.terrains.empty() ? std::move(own) : options.terrains;
}

TerrainSource open_heights(std::string_view name, std::uint64_t seed) {
  TerrainSource source = open_terrain(name, seed);
  if (!source.heights) {
    throw usage_error("the experiment needs a height field, not a solid", name, "name a height field");
  }
  return source;
}

TerrainSource open_filled_heights(std::string_view name, std::uint64_t seed) {
  TerrainSource source = open_heights(name, seed);
  const std::size_t holes = height_range(*source.heights).no_data;
  if (holes == 0) return source;
  source.heights = fill_no_data(*source.heights);
  source.notes.push_back(fmt::format("{} samples without height were filled from around them", holes));
  return source;
}

Heightfield noise_heights(const noise::Graph& graph, noise::Node root, int size, float cell, float lift,
                          float relief) {
  Heightfield field;
  field.width = field.depth = size;
  field.cell_x = field.cell_z = cell;
  const auto length = static_cast<std::size_t>(size);
  field.heights.resize(length * length);
  const noise::Program program(graph, root);
  std::vector<float> x(length);
  for (int i = 0; i < size; ++i) x[i] = static_cast<float>(i) * field.cell_x;
  tbb::parallel_for(tbb::blocked_range<int>(0, size), [&](const tbb::blocked_range<int>& rows) {
    const std::vector<float> y(length, 0.0F);
    std::vector<float> z(length);
    for (int j = rows.begin(); j < rows.end(); ++j) {
      std::fill(z.begin(), z.end(), static_cast<float>(j) * field.cell_z);
      const std::span row(field.heights.data() + static_cast<std::size_t>(j) * length, length);
      program.points(x, y, z, row);
      for (float& h : row) h = lift + relief * h;
    }
  });
  return field;
}

Heightfield noise_ridges(int size, std::uint64_t seed) {
  noise::Graph graph;
  const noise::Node root = graph.ridged_multifractal({.seed = seed, .frequency = kFrequency, .octaves = 8});
  return noise_heights(graph, root, size, 30, 200, 1600);
}

Heightfield noise_hills(int size, std::uint64_t seed) {
  noise::Graph graph;
  const noise::Node root = graph.fbm({.seed = seed, .frequency = kFrequency, .octaves = 8});
  return noise_heights(graph, root, size, 30, 800, 800);
}

Heightfield whole_metres(Heightfield field) {
  for (float& h : field.heights) h = std::round(h);
  return field;
}

}  // namespace terrabench
