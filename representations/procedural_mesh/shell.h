// From polygons to the closed triangles of a solid, for "meshgrow" meshes used as terrain.
#pragma once

#include <span>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"
#include "representations/procedural_mesh/triangle_columns.h"
#include "terrain/mesh.h"

namespace terrabench {

// A quadrilateral is cut along its shorter diagonal, any other polygon into a fan around its first corner.
// O(corners) on all threads.
std::vector<Triangle> triangulate(const FaceMesh&);

struct DirectedEdge {
  std::uint32_t from, to;
};
// The edges with one triangle, as it runs through them, by their lower vertex. No edge has more than two
// triangles, and fewer than 2^31 vertices exist. O(n log n).
std::vector<DirectedEdge> open_edges(std::span<const Triangle>);

// Closes sheets, the connected parts that have open edges: with walls from these down to `floor`, and with
// a copy of the sheet at the floor. Closed parts stay as they are. Vertices that join several fans are
// doubled, so that the result is watertight. O(n log n).
TriangleMesh close_down(std::vector<glm::vec3> positions, std::vector<Triangle> triangles, float floor);

// What the closed parts enclose, m³: negative where they are turned inside out. `open`: open_edges() of the
// triangles. O(n).
double volume_of_closed_parts(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                              std::span<const DirectedEdge> open);

// The area of the triangles in sheets as seen from above, m²: negative where they look down.
double area_of_sheets(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

}  // namespace terrabench
