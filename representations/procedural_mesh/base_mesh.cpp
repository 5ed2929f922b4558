#include "representations/procedural_mesh/base_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "representations/procedural_mesh/growing/frame.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

void add_face(Primitive& p, Part part, std::initializer_list<std::uint32_t> corners) {
  p.mesh.corners.insert(p.mesh.corners.end(), corners);
  p.mesh.first_corner.push_back(static_cast<std::uint32_t>(p.mesh.corners.size()));
  p.parts.push_back(part);
}

glm::vec2 around_axis(const glm::dvec3& p, double height) {
  const double u = std::abs(std::atan2(p.z, p.x)) / std::numbers::pi;
  return {static_cast<float>(u), static_cast<float>(p.y / height + 0.5)};
}

}  // namespace

Primitive plane(glm::dvec2 size, std::uint32_t cells_x, std::uint32_t cells_z) {
  Primitive p;
  p.mesh.first_corner.push_back(0);
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
  p.mesh.first_corner.push_back(0);
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
  p.mesh.first_corner.push_back(0);
  for (std::uint32_t j = 0; j <= cells; ++j) {
    const double v = static_cast<double>(j) / cells;
    const double radius = std::lerp(bottom_radius, top_radius, v);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = -2 * std::numbers::pi * i / sides;  // counter-clockwise seen from above
      p.mesh.positions.emplace_back(radius * std::cos(angle), (v - 0.5) * height, radius * std::sin(angle));
      p.mesh.texture.emplace_back(1 - std::abs(1 - 2.0 * i / sides), v);
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) p.mesh.corners.push_back(sides - 1 - i);
  p.mesh.first_corner.push_back(sides);
  p.parts.push_back(Part::kBottom);
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = j * sides + i, b = j * sides + (i + 1) % sides;
      add_face(p, Part::kSides, {a, b, b + sides, a + sides});
    }
  }
  for (std::uint32_t i = 0; i < sides; ++i) p.mesh.corners.push_back(cells * sides + i);
  p.mesh.first_corner.push_back(static_cast<std::uint32_t>(p.mesh.corners.size()));
  p.parts.push_back(Part::kTop);
  return p;
}

namespace {

class BaseCheck {
 public:
  BaseCheck(const FaceMesh& mesh, const std::string& where) : mesh_(mesh), where_(where) {}

  void run() {
    for (std::uint32_t f = 0; f < mesh_.faces(); ++f) face(f);
    fans();
  }

 private:
  [[noreturn]] void fail(const std::string& what, std::string_view advice) const {
    throw bad_input(fmt::format("the base mesh is not well formed: {}", what), where_, advice);
  }

  void face(std::uint32_t f) {
    const std::span<const std::uint32_t> corners(mesh_.corners.data() + mesh_.first_corner[f],
                                                 mesh_.corners.data() + mesh_.first_corner[f + 1]);
    if (corners.size() < 3)
      fail(fmt::format("face {} has {} corners", f, corners.size()), "give it 3 or more");
    std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      fail(fmt::format("face {} has a corner twice", f), "list each corner once");
    }
    if (sorted.back() >= mesh_.positions.size()) {
      fail(fmt::format("face {} names vertex {} of {}", f, sorted.back(), mesh_.positions.size()),
           "count vertices from 0");
    }
    const FaceShape shape = face_shape(corners, mesh_.positions);
    if (!(shape.area > 1e-9 * shape.size * shape.size))
      fail(fmt::format("face {} has no area", f), "move its corners");
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
      const std::uint32_t before = corners[(i + corners.size() - 1) % corners.size()];
      if (!next_.emplace(std::pair(a, b), before).second) {
        fail(fmt::format("two faces run through the edge from {} to {} in this direction", a, b),
             "give an edge two faces at most, and list corners counter-clockwise seen from outside");
      }
    }
  }

  // The directed edges from a vertex, sorted; next_ leads from one to the next around the vertex.
  void fans() const {
    auto at = next_.begin();
    for (std::uint32_t v = 0; v < mesh_.positions.size(); ++v) {
      std::vector<std::uint32_t> targets;
      for (; at != next_.end() && at->first.first == v; ++at) targets.push_back(at->first.second);
      if (targets.empty()) fail(fmt::format("vertex {} belongs to no face", v), "remove it");
      // Where the fan is open it starts at the edge that no other face shares.
      std::uint32_t start = targets[0];
      for (const std::uint32_t target : targets) {
        if (!next_.contains({target, v})) start = target;
      }
      std::size_t walked = 0;
      for (std::uint32_t to = start; walked <= targets.size();) {
        const auto found = next_.find({v, to});
        if (found == next_.end()) break;
        ++walked;
        to = found->second;
        if (to == start) break;
      }
      if (walked != targets.size()) {
        fail(fmt::format("vertex {} joins two fans of faces", v), "give each fan a vertex of its own");
      }
    }
  }

  const FaceMesh& mesh_;
  const std::string& where_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> next_;
};

}  // namespace

void check_base(const FaceMesh& mesh, const std::string& where) { BaseCheck(mesh, where).run(); }

}  // namespace terrabench::growing
