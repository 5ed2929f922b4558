#include "representations/procedural_mesh/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

namespace terrabench {
namespace {

constexpr std::size_t kNamed = 16;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// One face's passage through an edge, from `corner` to the next.
struct Half {
  std::uint32_t low, high, corner;
  bool forward;  // from low to high
};

class Check {
 public:
  Check(const FaceMesh& mesh, const MeshCheckOptions& options) : mesh_(mesh), options_(options) {}

  MeshReport run() {
    positions();
    faces();
    edges();
    fans();
    for (const auto& [vertex, edge] : vertices_in_edges(mesh_.positions, boundary_, options_.tolerance)) {
      fault(MeshFault::kTVertex,
            [&] { return fmt::format("vertex {} lies in the edge {}–{}", vertex, edge.first, edge.second); });
    }
    return std::move(report_);
  }

 private:
  template <class Text>
  void fault(MeshFault which, const Text& text) {
    ++report_.counts[static_cast<std::size_t>(which)];
    if (report_.first.size() < kNamed) report_.first.push_back(text());
  }

  void positions() {
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      if (is_finite(mesh_.positions[v])) continue;
      fault(MeshFault::kNotFinite, [&] { return fmt::format("vertex {}: its position is not finite", v); });
    }
  }

  // The corners of a face, or nothing when they are no face. Faces follow one another, so that no list of
  // faces can be larger than that of corners.
  std::span<const std::uint32_t> corners_of(std::size_t f) {
    const std::uint32_t first = mesh_.first_corner[f], last = mesh_.first_corner[f + 1];
    const bool listed = first == next_corner_ && first <= last && last <= mesh_.corners.size();
    if (listed) next_corner_ = last;
    const bool inside = listed && std::all_of(mesh_.corners.begin() + first, mesh_.corners.begin() + last,
                                              [&](std::uint32_t v) { return v < mesh_.positions.size(); });
    if (!inside) {
      fault(MeshFault::kBadIndex, [&] { return fmt::format("face {}: an index is out of range", f); });
      return {};
    }
    if (last - first < 3) {
      fault(MeshFault::kFewCorners, [&] { return fmt::format("face {}: {} corners", f, last - first); });
      return {};
    }
    return {mesh_.corners.data() + first, last - first};
  }

  void faces() {
    used_.assign(mesh_.positions.size(), false);
    halves_.reserve(mesh_.corners.size());
    next_.assign(mesh_.corners.size(), kNone);
    for (std::size_t f = 0; f < mesh_.faces(); ++f) {
      const auto face = corners_of(f);
      for (const std::uint32_t v : face) used_[v] = true;
      if (face.empty() || repeats(f, face)) continue;
      shape(f, face);
      const auto n = static_cast<std::uint32_t>(face.size());
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = face[i], b = face[(i + 1) % n], c = mesh_.first_corner[f] + i;
        next_[c] = i + 1 < n ? c + 1 : mesh_.first_corner[f];
        halves_.push_back({std::min(a, b), std::max(a, b), c, a < b});
      }
    }
    for (std::size_t v = 0; v < used_.size(); ++v) {
      if (!used_[v]) fault(MeshFault::kUnusedVertex, [&] { return fmt::format("vertex {}: no face", v); });
    }
  }

  bool repeats(std::size_t f, std::span<const std::uint32_t> face) {
    sorted_.assign(face.begin(), face.end());
    std::sort(sorted_.begin(), sorted_.end());
    const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end());
    if (twice == sorted_.end()) return false;
    fault(MeshFault::kRepeatedVertex, [&] { return fmt::format("face {}: vertex {} twice", f, *twice); });
    return true;
  }

  void shape(std::size_t f, std::span<const std::uint32_t> face) {
    const auto at = [&](std::size_t i) { return glm::dvec3(mesh_.positions[face[i % face.size()]]); };
    glm::dvec3 doubled(0);
    double perimeter = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const double length = glm::distance(at(i), at(i + 1));
      perimeter += length;
      doubled += glm::cross(at(i) - at(0), at(i + 1) - at(0));
      if (length == 0) {
        fault(MeshFault::kZeroEdge, [&] {
          return fmt::format("face {}: vertices {} and {} are at one place", f, face[i],
                             face[(i + 1) % face.size()]);
        });
      }
    }
    if (glm::length(doubled) / 2 <= static_cast<double>(options_.least_area) * perimeter * perimeter) {
      fault(MeshFault::kZeroArea, [&] { return fmt::format("face {}: no area", f); });
    }
  }

  // Equal edges side by side, found by sorting within buckets of the lower vertex.
  void edges() {
    std::vector<std::uint32_t> first(mesh_.positions.size() + 2);
    for (const Half& h : halves_) ++first[h.low + 2];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Half> sorted(halves_.size());
    for (const Half& h : halves_) sorted[first[h.low + 1]++] = h;
    halves_ = std::move(sorted);
    twin_.assign(mesh_.corners.size(), kNone);
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const auto begin = halves_.begin() + first[v], end = halves_.begin() + first[v + 1];
      std::sort(begin, end, [](const Half& a, const Half& b) {
        return a.high != b.high ? a.high < b.high : a.corner < b.corner;
      });
      for (auto i = begin, j = begin; i != end; i = j) {
        while (j != end && j->high == i->high) ++j;
        edge({&*i, static_cast<std::size_t>(j - i)});
      }
    }
  }

  void edge(std::span<const Half> faces) {
    const std::uint32_t a = faces[0].low, b = faces[0].high;
    ++report_.edges;
    if (faces.size() > 2) {
      fault(MeshFault::kManyFaces, [&] { return fmt::format("edge {}–{}: {} faces", a, b, faces.size()); });
    } else if (faces.size() == 2) {
      twin_[faces[0].corner] = faces[1].corner;
      twin_[faces[1].corner] = faces[0].corner;
      if (faces[0].forward == faces[1].forward) {
        fault(MeshFault::kDirectedTwice,
              [&] { return fmt::format("edge {}–{}: both faces in the same direction", a, b); });
      }
    } else {
      ++report_.boundary_edges;
      boundary_.push_back({a, b});
      if (options_.boundary_meant) return;
      fault(MeshFault::kUnmeantBoundary, [&] { return fmt::format("edge {}–{}: a hole", a, b); });
    }
  }

  // Joins the corners of a vertex that share an edge there; a vertex with more than one group has several
  // fans.
  void fans() {
    std::vector<std::uint32_t> parent(mesh_.corners.size());
    std::iota(parent.begin(), parent.end(), 0U);
    const auto root = [&](std::uint32_t c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    const auto join = [&](std::uint32_t c, std::uint32_t d) {
      const std::uint32_t x = root(c), y = root(d);
      parent[std::max(x, y)] = std::min(x, y);
    };
    for (const Half& h : halves_) {
      const std::uint32_t c = h.corner, d = twin_[c];
      if (d == kNone) continue;
      const bool same_direction = mesh_.corners[c] == mesh_.corners[d];
      join(c, same_direction ? d : next_[d]);
      join(next_[c], same_direction ? next_[d] : d);
    }
    std::vector<std::uint32_t> fan(mesh_.positions.size(), kNone);
    std::vector<bool> told(mesh_.positions.size());
    for (const Half& h : halves_) {
      const std::uint32_t v = mesh_.corners[h.corner], r = root(h.corner);
      if (fan[v] == kNone) fan[v] = r;
      if (fan[v] == r || told[v]) continue;
      told[v] = true;
      fault(MeshFault::kSeveralFans, [&] { return fmt::format("vertex {}: several fans of faces", v); });
    }
  }

  const FaceMesh& mesh_;
  const MeshCheckOptions& options_;
  MeshReport report_;
  std::vector<Half> halves_;
  std::vector<std::uint32_t> next_, twin_;  // per corner, within its face and across its edge
  std::vector<bool> used_;
  std::uint32_t next_corner_ = 0;
  std::vector<std::uint32_t> sorted_;
  std::vector<VertexPair> boundary_;
};

}  // namespace

std::size_t MeshReport::faults() const {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

MeshReport check_mesh(const FaceMesh& mesh, const MeshCheckOptions& options) {
  return Check(mesh, options).run();
}

// The ends are sorted along x, and each edge is compared with those beside it.
std::vector<VertexInEdge> vertices_in_edges(std::span<const glm::vec3> positions,
                                            std::span<const VertexPair> edges, float tolerance) {
  std::vector<std::pair<double, std::uint32_t>> ends;
  for (const auto& [a, b] : edges) {
    for (const std::uint32_t v : {a, b}) {
      if (is_finite(positions[v])) ends.emplace_back(positions[v].x, v);
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<VertexInEdge> found;
  for (const VertexPair& edge : edges) {
    if (!is_finite(positions[edge.first]) || !is_finite(positions[edge.second])) continue;
    const glm::dvec3 a(positions[edge.first]), b(positions[edge.second]), along = b - a;
    // Half a unit in the last place along each axis, for the result and for a sum or a product before it.
    const double rounding =
        glm::length(glm::max(glm::abs(a), glm::abs(b))) * double{std::numeric_limits<float>::epsilon()};
    const double distance = std::max(double{tolerance} * glm::length(along), rounding);
    const std::size_t before = found.size();
    const double last = std::max(a.x, b.x) + distance;
    for (auto at = std::lower_bound(ends.begin(), ends.end(), std::pair(std::min(a.x, b.x) - distance, 0U));
         at != ends.end() && at->first <= last; ++at) {
      const glm::dvec3 p(positions[at->second]);
      const double square = glm::dot(along, along);
      const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
      if (glm::distance(p, a + along * t) <= distance && glm::distance(p, a) > distance &&
          glm::distance(p, b) > distance) {
        found.push_back({at->second, edge});
      }
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end(),
              [](const VertexInEdge& v, const VertexInEdge& w) { return v.vertex < w.vertex; });
  }
  return found;
}

}  // namespace terrabench
