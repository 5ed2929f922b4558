// A polygon mesh as flat arrays: what refinement, placement and growing of "meshgrow" work on.
//
// Faces are polygons of 3 or more corners, counter-clockwise seen from outside. A vertex may lie on a
// boundary, and an edge has one or two faces; two faces at an edge run through it in opposite directions.
#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>
#include <vector>

#include "terrain/mesh.h"

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
  std::span<const std::uint32_t> face(std::size_t f) const {
    return {corners.data() + first_corner[f], corners.data() + first_corner[f + 1]};
  }
  void add_face(std::span<const std::uint32_t> vertices) {
    if (first_corner.empty()) first_corner.push_back(0);
    corners.insert(corners.end(), vertices.begin(), vertices.end());
    first_corner.push_back(static_cast<std::uint32_t>(corners.size()));
  }
  void add_face(std::initializer_list<std::uint32_t> vertices) {
    add_face(std::span(vertices.begin(), vertices.size()));
  }
};

}  // namespace terrabench
