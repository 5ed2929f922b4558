#include "experiments/figures/ground.h"

#include <cmath>

namespace terrabench::figures {

Image heightmap_image(const Heightfield& field) {
  const HeightRange range = height_range(field);
  const float span = range.highest - range.lowest;
  Image image(field.width, field.depth, {});
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float share = span > 0 ? (field.at(i, j) - range.lowest) / span : 0.5F;
      const auto grey = static_cast<std::uint8_t>(std::lround(255 * share));
      image.set(i, j, {grey, grey, grey});
    }
  }
  return image;
}

TriangleMesh ground_mesh(const Heightfield& field) {
  TriangleMesh mesh;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      mesh.positions.emplace_back(static_cast<float>(i) * field.cell_x, field.at(i, j),
                                  static_cast<float>(j) * field.cell_z);
    }
  }
  for (int j = 0; j + 1 < field.depth; ++j) {
    for (int i = 0; i + 1 < field.width; ++i) {
      const auto a = static_cast<std::uint32_t>(j * field.width + i), b = a + 1;
      const auto c = a + static_cast<std::uint32_t>(field.width), d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

TriangleMesh block_sides(int columns, int rows, const std::function<glm::vec3(int i, int j)>& surface,
                         float floor) {
  TriangleMesh mesh;
  // Adds the side below a border edge; seen from above, the ground is left of from → to.
  const auto add_side = [&](const glm::vec3& from, const glm::vec3& to) {
    add_quad(mesh, {glm::vec3(from.x, floor, from.z), glm::vec3(to.x, floor, to.z), to, from});
  };
  for (int i = 0; i + 1 < columns; ++i) {
    add_side(surface(i, rows - 1), surface(i + 1, rows - 1));
    add_side(surface(i + 1, 0), surface(i, 0));
  }
  for (int j = 0; j + 1 < rows; ++j) {
    add_side(surface(columns - 1, j + 1), surface(columns - 1, j));
    add_side(surface(0, j), surface(0, j + 1));
  }
  return mesh;
}

void add_quad(TriangleMesh& mesh, const std::array<glm::vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + k);
}

}  // namespace terrabench::figures
