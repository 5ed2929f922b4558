#include "representations/procedural_mesh/base_mesh.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <numeric>

namespace terrabench::growing {
namespace {

void add_face(Primitive& p, Part part, std::initializer_list<std::uint32_t> corners) {
  p.mesh.add_face(corners);
  p.parts.push_back(part);
}

glm::vec2 around_axis(const glm::dvec3& p, double height) {
  const double u = std::abs(std::atan2(p.z, p.x)) / std::numbers::pi;
  return {static_cast<float>(u), static_cast<float>(p.y / height + 0.5)};
}

}  // namespace

Primitive plane(glm::dvec2 size, std::uint32_t cells_x, std::uint32_t cells_z) {
  Primitive p;
  for (std::uint32_t j = 0; j <= cells_z; ++j) {
    for (std::uint32_t i = 0; i <= cells_x; ++i) {
      const double u = static_cast<double>(i) / cells_x, v = static_cast<double>(j) / cells_z;
      p.mesh.positions.emplace_back((u - 0.5) * size.x, 0, (v - 0.5) * size.y);
      p.mesh.texture.emplace_back(u, v);
    }
  }
  const std::uint32_t row = cells_x + 1;
  for (std::uint32_t j = 0; j < cells_z; ++j) {
    for (std::uint32_t i = 0; i < cells_x; ++i) {
      const std::uint32_t a = j * row + i;
      add_face(p, Part::kTop, {a, a + row, a + row + 1, a + 1});
    }
  }
  return p;
}

Primitive cube(const glm::dvec3& size, const glm::uvec3& cells) {
  Primitive p;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> vertices;
  const auto vertex = [&](const std::array<std::uint32_t, 3>& at) {
    const auto [found, is_new] = vertices.emplace(at, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) {
      glm::dvec3 q;
      for (int k = 0; k < 3; ++k) {
        q[k] = (static_cast<double>(at[static_cast<std::size_t>(k)]) / cells[k] - 0.5) * size[k];
      }
      p.mesh.positions.emplace_back(q);
      p.mesh.texture.push_back(around_axis(q, size.y));
    }
    return found->second;
  };
  // Bottom, top, then the four sides. The axes a, b run so that a × b points outwards for `far`.
  constexpr struct {
    std::size_t axis;
    bool far;
  } kFaces[] = {{1, false}, {1, true}, {0, false}, {0, true}, {2, false}, {2, true}};
  for (const auto& [axis, far] : kFaces) {
    const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
    const auto count = [&](std::size_t k) { return cells[static_cast<int>(k)]; };
    // Seen from the other side, the axes swap.
    const std::size_t first = far ? a : b, second = far ? b : a;
    for (std::uint32_t j = 0; j < count(second); ++j) {
      for (std::uint32_t i = 0; i < count(first); ++i) {
        const auto at = [&](std::uint32_t x, std::uint32_t y) {
          std::array<std::uint32_t, 3> q{};
          q[axis] = far ? count(axis) : 0;
          q[first] = x;
          q[second] = y;
          return vertex(q);
        };
        const Part part = axis != 1 ? Part::kSides : far ? Part::kTop : Part::kBottom;
        add_face(p, part, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return p;
}

Primitive sphere(double radius, std::uint32_t cells) {
  Primitive p = cube(glm::dvec3(2), glm::uvec3(cells));
  for (std::size_t v = 0; v < p.mesh.positions.size(); ++v) {
    // Equal angles between the lines of the cube give cells of more equal size.
    const glm::dvec3 q = glm::dvec3(p.mesh.positions[v]) * (std::numbers::pi / 4);
    const glm::dvec3 at = glm::normalize(glm::dvec3(std::tan(q.x), std::tan(q.y), std::tan(q.z))) * radius;
    p.mesh.positions[v] = glm::vec3(at);
    p.mesh.texture[v] = around_axis(at, 2 * radius);
  }
  return p;
}

Primitive prism(std::uint32_t sides, double bottom_radius, double top_radius, double height,
                std::uint32_t cells) {
  Primitive p;
  for (std::uint32_t j = 0; j <= cells; ++j) {
    const double v = static_cast<double>(j) / cells;
    const double radius = std::lerp(bottom_radius, top_radius, v);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = -2 * std::numbers::pi * i / sides;  // counter-clockwise seen from above
      p.mesh.positions.emplace_back(radius * std::cos(angle), (v - 0.5) * height, radius * std::sin(angle));
      p.mesh.texture.emplace_back(1 - std::abs(1 - 2.0 * i / sides), v);
    }
  }
  std::vector<std::uint32_t> ring(sides);
  std::iota(ring.rbegin(), ring.rend(), 0U);
  p.mesh.add_face(ring);
  p.parts.push_back(Part::kBottom);
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = j * sides + i, b = j * sides + (i + 1) % sides;
      add_face(p, Part::kSides, {a, b, b + sides, a + sides});
    }
  }
  std::iota(ring.begin(), ring.end(), cells * sides);
  p.mesh.add_face(ring);
  p.parts.push_back(Part::kTop);
  return p;
}

}  // namespace terrabench::growing
