#include "experiments/hybrid/grounds.h"

#include <algorithm>
#include <cmath>

#include "experiments/figures/ground.h"
#include "experiments/ground.h"
#include "terrain/files.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {

TerrainSource wide_ground(const WideGround& wide) {
  TerrainSource source = noise::cave_source({.seed = wide.seed, .extent = wide.cube});
  // The graph is defined everywhere; only the bounds cut it.
  Bounds& box = source.solid->bounds;
  box.high.x = box.high.z = wide.cube * static_cast<float>(wide.cubes);
  source.name = "caves, side by side";
  source.checksum = source.solid->checksum = checksum(source.checksum + " × " + std::to_string(wide.cubes));
  return source;
}

Heightfield grassland(std::uint64_t seed, int cells, float cliffs) {
  noise::Graph graph;
  const noise::Node root =
      graph.fbm({.seed = seed, .frequency = 1 / 40.0F, .octaves = 4, .lacunarity = 2, .gain = 0.4F});
  Heightfield field = noise_heights(graph, root, cells + 1, 64 / static_cast<float>(cells));
  // Terraces: within each, most of the rise happens in a narrow part of the noise's range.
  constexpr float kRelief = 16, kTerrace = 5;  // metres
  for (float& height : field.heights) {
    const float terraces = kRelief * height / kTerrace, floor = std::floor(terraces);
    const float inside = std::clamp((terraces - floor - 0.42F) / 0.16F, 0.0F, 1.0F);
    const float cliff = inside * inside * (3 - 2 * inside);
    height = kTerrace * (floor + (1 - cliffs) * (terraces - floor) +
                         cliffs * (0.8F * cliff + 0.2F * (terraces - floor)));
  }
  return field;
}

TriangleMesh grassland_mesh(const Heightfield& field) {
  TriangleMesh mesh = figures::ground_mesh(field);
  for (glm::vec3& p : mesh.positions) p += glm::vec3(100, 0, 100);
  compute_normals(mesh);
  return mesh;
}

double largest_step(const Heightfield& field) {
  float largest = 0;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      if (i > 0) largest = std::max(largest, std::abs(field.at(i, j) - field.at(i - 1, j)));
      if (j > 0) largest = std::max(largest, std::abs(field.at(i, j) - field.at(i, j - 1)));
    }
  }
  return largest;
}

}  // namespace terrabench::hybrid
