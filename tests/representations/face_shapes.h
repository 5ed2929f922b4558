// Small polygon meshes with boundaries, creases and extraordinary vertices. Positions are shaken by a fixed
// amount per vertex, so that no symmetry hides an error.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "representations/procedural_mesh/base_mesh.h"

namespace terrabench {

using Faces = std::vector<std::vector<std::uint32_t>>;

inline FaceMesh mesh_of(std::vector<glm::vec3> positions, const Faces& faces) {
  FaceMesh mesh;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto x = static_cast<float>(i);
    positions[i] += 0.2F * glm::vec3(std::sin(1 + 7 * x), std::sin(2 + 5 * x), std::sin(3 + 3 * x));
  }
  mesh.positions = std::move(positions);
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}
inline FaceMesh shaken(const FaceMesh& mesh) {
  Faces faces;
  for (std::size_t f = 0; f < mesh.faces(); ++f) faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
  return mesh_of(mesh.positions, faces);
}
inline glm::vec3 on_circle(double turn, double radius, double height) {
  const double angle = 2 * std::numbers::pi * turn;
  return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

inline FaceMesh cube(bool open = false) {
  Faces faces{{0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  if (!open) faces.insert(faces.begin() + 1, {4, 5, 6, 7});
  return mesh_of(
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
      faces);
}
inline FaceMesh tetrahedron() {
  return mesh_of({{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}},
                 {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
}
// Quadrilaterals over x and z, facing up, `n` by `n`, a metre wide.
inline FaceMesh grid(std::uint32_t n) { return shaken(growing::plane(glm::dvec2(n), n, n).mesh); }
// Closed and regular: every vertex has four faces.
inline FaceMesh torus(std::uint32_t n, std::uint32_t m) {
  std::vector<glm::vec3> positions;
  Faces faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const glm::vec3 around = on_circle(1.0 * j / m, 1, 0);
      positions.push_back(on_circle(1.0 * i / n, 3 + around.x, around.z));
      const std::uint32_t k = (i + 1) % n, l = (j + 1) % m;
      faces.push_back({i * m + j, i * m + l, k * m + l, k * m + j});
    }
  }
  return mesh_of(std::move(positions), faces);
}
// A pyramid over a polygon of n corners: a vertex of valence n, triangles and an n-gon.
inline FaceMesh pyramid(std::uint32_t n) {
  std::vector<glm::vec3> positions;
  Faces faces(1);
  for (std::uint32_t i = 0; i < n; ++i) {
    positions.push_back(on_circle(1.0 * i / n, 2, 0));
    faces[0].push_back(i);
    faces.push_back({i, n, (i + 1) % n});
  }
  positions.push_back({0, 2, 0});
  return mesh_of(std::move(positions), faces);
}
// n quadrilaterals around a vertex, with a boundary.
inline FaceMesh star(std::uint32_t n) {
  std::vector<glm::vec3> positions{{0, 1, 0}};
  Faces faces;
  for (std::uint32_t i = 0; i < 2 * n; ++i)
    positions.push_back(on_circle(-0.5 * i / n, i % 2 == 0 ? 1 : 1.5, 0));
  for (std::uint32_t i = 0; i < n; ++i) faces.push_back({0, 2 * i + 1, 2 * i + 2, (2 * i + 2) % (2 * n) + 1});
  return mesh_of(std::move(positions), faces);
}
// Two triangles and a pentagon, open; vertex 0 has two fans.
inline FaceMesh bow_tie() {
  return mesh_of({{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {-1, 0, 1}, {-2, 0, 0}, {3, 1, 1}, {2, 1, 2}},
                 {{0, 1, 2}, {0, 4, 3}, {2, 1, 6, 5}});
}

inline FaceMesh with_creases(FaceMesh mesh, std::vector<Crease> creases,
                             std::vector<SharpVertex> points = {}) {
  mesh.creases = std::move(creases);
  mesh.sharp_vertices = std::move(points);
  return mesh;
}

struct Shape {
  std::string name;
  FaceMesh mesh;
};
inline std::vector<Shape> shapes() {
  return {{"cube", cube()},
          {"tetrahedron", tetrahedron()},
          {"one face", grid(1)},
          {"grid", grid(3)},
          {"open box", cube(true)},
          {"torus", torus(5, 4)},
          {"pyramid", pyramid(7)},
          {"star", star(5)},
          {"star of three", star(3)},
          {"bow tie", bow_tie()},
          {"cube, sharp lid", with_creases(cube(), {{4, 5, 2}, {5, 6, 2}, {6, 7, 2}, {7, 4, 2}})},
          {"cube, dart", with_creases(cube(), {{0, 1, 3}})},
          {"cube, lasting dart", with_creases(cube(), {{0, 1, 10}, {1, 2, 10}})},
          {"cube, corner", with_creases(cube(), {{6, 5, 10}, {6, 7, 10}, {6, 2, 1}})},
          {"cube, mixed", with_creases(cube(), {{4, 5, 1}, {5, 6, 2}, {6, 7, 3}, {7, 4, 12}, {5, 1, 2}})},
          {"grid, crease", with_creases(grid(3), {{4, 5, 2}, {5, 6, 2}, {6, 7, 1}, {5, 9, 1}})},
          {"grid, points", with_creases(grid(3), {}, {{5, 2}, {0, 1}, {10, 10}})},
          {"pyramid, crease", with_creases(pyramid(6), {{0, 6, 2}, {3, 6, 2}, {1, 2, 1}})}};
}

}  // namespace terrabench
