#include "representations/procedural_mesh/shell.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "terrain/error.h"

namespace terrabench {
namespace {

std::uint32_t corner(const Triangle& t, int k) { return t[k == 3 ? 0 : k]; }

// Marks the vertices of sheets.
class Sheets {
 public:
  Sheets(std::size_t vertices, std::span<const Triangle> triangles, std::span<const DirectedEdge> open)
      : root_(vertices), in_sheet_(vertices, false) {
    std::iota(root_.begin(), root_.end(), 0U);
    for (const Triangle& t : triangles) {
      join(t.x, t.y);
      join(t.x, t.z);
    }
    for (const DirectedEdge& edge : open) in_sheet_[root(edge.from)] = true;
  }
  bool has(std::uint32_t v) { return in_sheet_[root(v)]; }

 private:
  std::uint32_t root(std::uint32_t v) {
    while (root_[v] != v) v = root_[v] = root_[root_[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ra = root(a), rb = root(b);
    root_[std::max(ra, rb)] = std::min(ra, rb);
  }

  std::vector<std::uint32_t> root_;
  std::vector<bool> in_sheet_;
};

// The triangle corners at the vertices where several open edges begin, sorted by vertex.
struct Use {
  std::uint32_t vertex, triangle;
};

std::vector<Use> uses_of_joints(std::size_t vertices, std::span<const Triangle> triangles,
                                std::span<const DirectedEdge> open) {
  std::vector<std::uint8_t> begin(vertices, 0);
  for (const DirectedEdge& edge : open) begin[edge.from] = begin[edge.from] == 0 ? 1 : 2;
  std::vector<Use> uses;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles[t][k];
      if (begin[v] == 2) uses.push_back({v, static_cast<std::uint32_t>(t)});
    }
  }
  std::stable_sort(uses.begin(), uses.end(), [](Use a, Use b) { return a.vertex < b.vertex; });
  return uses;
}

struct Neighbours {
  std::uint32_t next, previous;
};
Neighbours around(const Triangle& t, std::uint32_t v) {
  const int k = t.x == v ? 0 : t.y == v ? 1 : 2;
  return {corner(t, k + 1), t[(k + 2) % 3]};
}

// Gives each fan at a vertex but the first a vertex of its own. Whether there was any.
bool split_fans(std::vector<glm::vec3>& positions, std::vector<Triangle>& triangles,
                std::span<const DirectedEdge> open) {
  const std::vector<Use> uses = uses_of_joints(positions.size(), triangles, open);
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    const std::uint32_t v = uses[first].vertex;
    while (last < uses.size() && uses[last].vertex == v) ++last;
    const std::span here(uses.data() + first, last - first);
    const auto with_next = [&](std::uint32_t next) {
      return std::find_if(here.begin(), here.end(), [&](Use use) {
        const Triangle& t = triangles[use.triangle];
        return (t.x == v || t.y == v || t.z == v) && around(t, v).next == next;
      });
    };
    std::vector<std::uint32_t> heads;  // where fans begin
    for (const Use use : here) {
      const std::uint32_t next = around(triangles[use.triangle], v).next;
      const bool entered = std::any_of(here.begin(), here.end(), [&](Use other) {
        return around(triangles[other.triangle], v).previous == next;
      });
      if (!entered) heads.push_back(next);
    }
    for (std::size_t h = 1; h < heads.size(); ++h) {
      const auto copy = static_cast<std::uint32_t>(positions.size());
      positions.push_back(glm::vec3(positions[v]));
      for (auto use = with_next(heads[h]); use != here.end();) {
        Triangle& t = triangles[use->triangle];
        const std::uint32_t after = around(t, v).previous;
        for (int k = 0; k < 3; ++k) t[k] = t[k] == v ? copy : t[k];
        use = with_next(after);
      }
    }
  }
  return !uses.empty();
}

}  // namespace

std::vector<Triangle> triangulate(const FaceMesh& mesh) {
  const auto& first = mesh.first_corner;
  std::vector<Triangle> triangles(mesh.corners.size() - 2 * mesh.faces());
  tbb::parallel_for(std::size_t{0}, mesh.faces(), [&](std::size_t f) {
    const std::uint32_t* const c = mesh.corners.data() + first[f];
    const std::uint32_t corners = first[f + 1] - first[f];
    Triangle* const out = triangles.data() + first[f] - 2 * f;
    const auto diagonal = [&](int a, int b) {
      return glm::distance(glm::dvec3(mesh.positions[c[a]]), glm::dvec3(mesh.positions[c[b]]));
    };
    if (corners == 4 && diagonal(1, 3) < diagonal(0, 2)) {
      out[0] = {c[0], c[1], c[3]};
      out[1] = {c[1], c[2], c[3]};
      return;
    }
    for (std::uint32_t k = 2; k < corners; ++k) out[k - 2] = {c[0], c[k - 1], c[k]};
  });
  return triangles;
}

std::vector<DirectedEdge> open_edges(std::span<const Triangle> triangles) {
  require_memory(3 * triangles.size() * sizeof(std::uint64_t), "edges of a procedural mesh");
  std::vector<std::uint64_t> keys(3 * triangles.size());  // lower vertex, higher vertex, direction
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = triangles[t][k], b = corner(triangles[t], k + 1);
      keys[3 * t + static_cast<std::size_t>(k)] =
          std::min(a, b) << 33U | std::max(a, b) << 1U | static_cast<std::uint64_t>(a > b);
    }
  });
  tbb::parallel_sort(keys.begin(), keys.end());
  std::vector<DirectedEdge> open;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (k + 1 < keys.size() && keys[k] >> 1U == keys[k + 1] >> 1U) {
      ++k;
      continue;
    }
    const auto a = static_cast<std::uint32_t>(keys[k] >> 33U),
               b = static_cast<std::uint32_t>(keys[k] >> 1U & 0xFFFFFFFFU);
    open.push_back((keys[k] & 1U) == 0 ? DirectedEdge{a, b} : DirectedEdge{b, a});
  }
  return open;
}

TriangleMesh close_down(std::vector<glm::vec3> positions, std::vector<Triangle> triangles, float floor) {
  std::vector<DirectedEdge> open = open_edges(triangles);
  if (split_fans(positions, triangles, open)) open = open_edges(triangles);
  Sheets sheets(positions.size(), triangles, open);
  // Under each vertex of a sheet, one at the floor.
  std::vector<std::uint32_t> under(positions.size());
  const std::size_t vertices = positions.size();
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!sheets.has(v)) continue;
    under[v] = static_cast<std::uint32_t>(positions.size());
    positions.push_back({positions[v].x, floor, positions[v].z});
  }
  TriangleMesh mesh;
  mesh.indices.reserve(6 * triangles.size() + 6 * open.size());
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
  };
  for (const Triangle& t : triangles) add(t.x, t.y, t.z);
  for (const Triangle& t : triangles) {
    if (sheets.has(t.x)) add(under[t.x], under[t.z], under[t.y]);
  }
  for (const auto [from, to] : open) {
    add(to, from, under[from]);
    add(to, under[from], under[to]);
  }
  mesh.positions = std::move(positions);
  return mesh;
}

double volume_of_closed_parts(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                              std::span<const DirectedEdge> open) {
  const bool sheets_exist = !open.empty();
  Sheets sheets(sheets_exist ? positions.size() : 0, triangles.first(sheets_exist ? triangles.size() : 0),
                open);
  const glm::dvec3 origin = positions.empty() ? glm::vec3(0) : positions[0];
  double volume = 0;
  for (const Triangle& t : triangles) {
    if (sheets_exist && sheets.has(t.x)) continue;
    const glm::dvec3 a = glm::dvec3(positions[t.x]) - origin, b = glm::dvec3(positions[t.y]) - origin,
                     c = glm::dvec3(positions[t.z]) - origin;
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return volume;
}

double area_of_sheets(std::span<const glm::vec3> positions, std::span<const Triangle> triangles) {
  const std::vector<DirectedEdge> open = open_edges(triangles);
  double area = 0;  // by the border alone, which has the area of what it encloses
  for (const auto [from, to] : open) {
    const glm::dvec3 a = positions[from], b = positions[to];
    area += (a.z * b.x - a.x * b.z) / 2;
  }
  return area;
}

}  // namespace terrabench
