// What subdivision is compared with. Catmull–Clark subdivision as textbooks state it (Catmull and Clark
// 1978), with adjacency lists and in double precision; the eigenvalues by which it contracts the ring of a
// vertex; and small meshes. Shares no code with representations/procedural_mesh/subdivision.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"

namespace terrabench::meshgrow {

struct PlainMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::vector<std::uint32_t>> faces;  // vertices, counter-clockwise
};
PlainMesh plain(const FaceMesh&);

// One step. Boundary edges are creases, and a boundary vertex with one face is rounded off. The corner of
// each face becomes one quadrilateral: (its vertex, the edge to the next, the face, the edge from the one
// before). The first points are those of the vertices. O(corners log corners).
PlainMesh catmull_clark(const PlainMesh&);

// Closed: cube, tetrahedron, prism (two pentagons), sphere (of a cube's faces). Bounded: box (a cube without
// its top), fan (six quadrilaterals at a vertex), patch (five faces of 3, 4 and 5 corners at a vertex).
// With creases and sharp vertices, which this reference does not know: creased-cube (sharpness 1 to 3 around
// the top, and one for ever), darts (creases that end inside a sphere, or in a sharp vertex), creased-box
// (creases that meet the boundary), creased-patch (creases of all kinds at vertices of 3 to 5 faces).
inline constexpr std::array<std::string_view, 11> kShapes{
    "cube",  "tetrahedron",  "prism", "sphere",      "box",          "fan",
    "patch", "creased-cube", "darts", "creased-box", "creased-patch"};
bool has_creases(const FaceMesh&);
FaceMesh shape(std::string_view name);

// How far the faces of `ours` are from those of `reference`, face by face and corner by corner.
struct Comparison {
  std::size_t mismatches = 0;  // faces, corners or vertices without a partner of their own
  double largest = 0;          // distance between partners, as a share of the reference's diagonal
};
Comparison compare(std::span<const std::uint32_t> quads, std::span<const glm::dvec3> points,
                   const PlainMesh& reference);

// Of a vertex with n ≥ 3 faces: the largest eigenvalue below 1 of its subdivision matrix, among vectors that
// are constant around the vertex (turns = 0), or that turn once around it (turns = 1), by the power method.
// O(n).
double ring_eigenvalue(std::size_t n, int turns);

struct RootMeanSquare {
  double sum = 0, count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double value() const { return std::sqrt(sum / count); }
};

}  // namespace terrabench::meshgrow
