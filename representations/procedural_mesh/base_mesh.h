// The meshes from which models start: named primitives.
#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench::growing {

// Which symbol a face of a primitive gets.
enum class Part : std::uint8_t { kTop, kBottom, kSides };

struct Primitive {
  FaceMesh mesh;  // with texture coordinates
  std::vector<Part> parts;
};

// All are centred on the origin. Texture coordinates: on planes, x and z from 0 to 1; elsewhere u goes around
// the y axis from 0 to 1 and back, so that it has no seam, and v from the bottom, 0, to the top, 1.
Primitive plane(glm::dvec2 size, std::uint32_t cells_x, std::uint32_t cells_z);  // looks up
// Faces of the bottom come first, then the top, then the sides at low and high x, then z.
Primitive cube(const glm::dvec3& size, const glm::uvec3& cells);
Primitive sphere(double radius, std::uint32_t cells);  // a cube's, moved to the sphere
// A polygon as bottom, another as top, and one quadrilateral per side; cells: along the height.
Primitive prism(std::uint32_t sides, double bottom_radius, double top_radius, double height,
                std::uint32_t cells);

}  // namespace terrabench::growing
