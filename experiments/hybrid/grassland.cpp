#include "experiments/hybrid/grassland.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/figures/ground.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::hybrid {

Heightfield grassland(std::uint64_t seed, int cells, float cliffs) {
  noise::Graph graph;
  const noise::Node root =
      graph.fbm({.seed = seed, .frequency = 1 / 40.0F, .octaves = 4, .lacunarity = 2, .gain = 0.4F});
  const noise::Program program(graph, root);
  Heightfield field = Heightfield::zeros(cells + 1, cells + 1, kGrasslandMetres / static_cast<float>(cells),
                                         kGrasslandMetres / static_cast<float>(cells));
  const auto width = static_cast<std::size_t>(field.width);
  std::vector<float> x(width), y(width, 0.0F), z(width);
  for (int i = 0; i < field.width; ++i) x[static_cast<std::size_t>(i)] = static_cast<float>(i) * field.cell_x;
  for (int j = 0; j < field.depth; ++j) {
    std::fill(z.begin(), z.end(), static_cast<float>(j) * field.cell_z);
    program.points(x, y, z, std::span(field.heights).subspan(static_cast<std::size_t>(j) * width, width));
  }
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

}  // namespace terrabench::hybrid
