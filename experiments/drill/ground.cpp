#include "experiments/drill/ground.h"

#include <cctype>
#include <cmath>

#include "terrain/error.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::drill {
namespace {

constexpr int kPaperSize = 400;

TerrainSource from_heights(std::string_view name, Heightfield heights) {
  TerrainSource source;
  source.name = name;
  source.checksum = checksum(heights);
  source.heights = std::move(heights);
  return source;
}

// 30 m samples, whole metres, as elevation models have them.
TerrainSource from_noise(std::string_view name, const noise::Graph& graph, noise::Node root, float lift,
                         float relief) {
  Heightfield field;
  field.width = field.depth = kPaperSize;
  field.cell_x = field.cell_z = 30;
  field.heights.resize(static_cast<std::size_t>(kPaperSize) * kPaperSize);
  const noise::Program program(graph, root);
  std::vector<float> x(kPaperSize), y(kPaperSize, 0.0F), z(kPaperSize);
  for (int j = 0; j < kPaperSize; ++j) {
    for (int i = 0; i < kPaperSize; ++i) {
      x[i] = static_cast<float>(i) * field.cell_x;
      z[i] = static_cast<float>(j) * field.cell_z;
    }
    program.points(x, y, z,
                   std::span(field.heights).subspan(static_cast<std::size_t>(j) * kPaperSize, kPaperSize));
  }
  for (float& h : field.heights) h = std::round(lift + relief * h);
  return from_heights(name, std::move(field));
}

// The largest features are about a third of the ground wide.
constexpr float kFrequency = 1.0F / 4000;

TerrainSource noise_ridges(std::uint64_t seed) {
  noise::Graph graph;
  const noise::Node root = graph.ridged_multifractal({.seed = seed, .frequency = kFrequency, .octaves = 8});
  return from_noise("noise-ridges", graph, root, 200, 1600);
}

TerrainSource noise_hills(std::uint64_t seed) {
  noise::Graph graph;
  const noise::Node root = graph.fbm({.seed = seed, .frequency = kFrequency, .octaves = 8});
  return from_noise("noise-hills", graph, root, 800, 800);
}

}  // namespace

TerrainSource open_ground(std::string_view name, std::uint64_t seed) {
  if (name == "noise-ridges") return noise_ridges(seed);
  if (name == "noise-hills") return noise_hills(seed);
  if (name == "jacksboro-400") {
    return from_heights(name, resample(*open_terrain("jacksboro").heights, kPaperSize, kPaperSize));
  }
  TerrainSource source = open_terrain(name, seed);
  if (!source.heights) {
    throw usage_error("drills need a height field, not a solid", name, "name a terrain of heights");
  }
  return source;
}

std::vector<std::string> grounds(const RunOptions& options) {
  if (!options.terrains.empty()) return options.terrains;
  std::vector<std::string> names{std::string(kMainGround)};
  if (options.profile == Profile::kPaper) {
    names.insert(names.end(), {"jacksboro", "noise-ridges", "noise-hills"});
  }
  return names;
}

std::string file_name(std::string_view ground) {
  std::string name(ground.substr(ground.find_last_of('/') + 1));
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  }
  return name;
}

}  // namespace terrabench::drill
