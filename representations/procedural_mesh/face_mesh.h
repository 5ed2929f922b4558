// A polygon mesh as flat arrays: what refinement, placement and growing of "meshgrow" work on.
//
// Faces are polygons of 3 or more corners, counter-clockwise seen from outside. A vertex may lie on a
// boundary, and an edge has one or two faces; two faces at an edge run through it in opposite directions.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace terrabench {

// An edge between two vertices that stays sharp for this many refinements.
struct Crease {
  std::uint32_t a = 0, b = 0;
  int sharpness = 0;
};

// A vertex that stays where it is for this many refinements.
struct SharpVertex {
  std::uint32_t vertex = 0;
  int sharpness = 0;
};

struct FaceMesh {
  std::vector<glm::vec3> positions;         // metres
  std::vector<glm::vec2> texture;           // texture coordinates per vertex, or empty
  std::vector<std::uint32_t> first_corner;  // per face, and one more: the number of corners
  std::vector<std::uint32_t> corners;       // vertices of the faces, face by face
  std::vector<std::uint32_t> symbols;       // of a PL-system, per face, or empty; 0: none
  std::vector<Crease> creases;
  std::vector<SharpVertex> sharp_vertices;

  std::size_t faces() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
};

}  // namespace terrabench
