// Indexed triangles, which representations produce and renderers draw.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "terrain/solid.h"

namespace terrabench {

struct TriangleMesh {
  std::vector<glm::vec3> positions;    // metres
  std::vector<glm::vec3> normals;      // unit length, one per position; may be empty until compute_normals()
  std::vector<std::uint32_t> indices;  // three per triangle, counter-clockwise seen from the air

  std::size_t triangles() const { return indices.size() / 3; }
};

// The box around all positions; zero for none. O(positions).
Bounds box_of(std::span<const glm::vec3> positions);
Bounds bounds_of(const TriangleMesh&);

// Area-weighted vertex normals. O(triangles).
void compute_normals(TriangleMesh&);

// Whether a mesh is closed: an edge of one triangle is open, one of more than two is non-manifold.
struct EdgeReport {
  std::size_t edges = 0, open = 0, non_manifold = 0,
              misoriented = 0;  // misoriented: both triangles traverse it in the same direction
  bool watertight() const { return open == 0 && non_manifold == 0 && misoriented == 0; }
};
// O(triangles log triangles).
EdgeReport check_edges(const TriangleMesh&);

}  // namespace terrabench
