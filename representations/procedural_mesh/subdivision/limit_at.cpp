#include <algorithm>
#include <array>
#include <cassert>

#include "representations/procedural_mesh/subdivision/corner_walk.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench::subdivision {
namespace {

// 2^-50 of a face is less than the rounding of its points.
constexpr int kMostSteps = 50;

// The faces around one face, which comes first.
struct Patch {
  FaceMesh mesh;
  std::vector<glm::dvec3> points;
};

template <class Walk>
Patch patch_around(const Topology& t, const Walk& walk, std::span<const glm::dvec3> points,
                   std::uint32_t face) {
  std::vector<std::uint32_t> faces{face}, vertices;
  for (std::uint32_t c = walk.first(face); c < walk.first(face + 1); ++c) {
    for (const std::uint32_t use : t.uses_of(t.corners[c])) {
      if (std::ranges::find(faces, walk.face(use)) == faces.end()) faces.push_back(walk.face(use));
    }
  }
  Patch patch;
  const auto local = [&](std::uint32_t v) {
    const auto found = std::ranges::find(vertices, v);
    if (found != vertices.end()) return static_cast<std::uint32_t>(found - vertices.begin());
    vertices.push_back(v);
    patch.points.push_back(points[v]);
    patch.mesh.positions.emplace_back(points[v]);
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  for (const std::uint32_t f : faces) {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t c = walk.first(f); c < walk.first(f + 1); ++c) {
      corners.push_back(local(t.corners[c]));
      const std::uint32_t edge = t.corner_edge[c];
      if (t.sharpness[edge] > 0 && t.edges[edge].half[0] == c && t.edges[edge].half[1] != kNone) {
        patch.mesh.creases.push_back(
            {local(t.corners[c]), local(t.corners[walk.next(c)]), t.sharpness[edge]});
      }
    }
    patch.mesh.add_face(corners);
  }
  for (const SharpVertex& sharp : t.sharp_points) {
    const auto found = std::ranges::find(vertices, sharp.vertex);
    if (found == vertices.end()) continue;
    patch.mesh.sharp_vertices.push_back(
        {static_cast<std::uint32_t>(found - vertices.begin()), sharp.sharpness});
  }
  return patch;
}

std::array<double, 4> spline_weights(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, ((3 * t - 6) * t * t + 4) / 6, ((3 * s - 6) * s * s + 4) / 6, t * t * t / 6};
}

// Around the patch's first face: whether each corner has four quadrilaterals and nothing sharp.
bool is_regular(const Topology& t) {
  if (!t.first_corner.empty()) return false;
  for (std::uint32_t c = 0; c < 4; ++c) {
    const std::uint32_t v = t.corners[c];
    if (t.uses_of(v).size() != 4) return false;
    for (const SharpVertex& sharp : t.sharp_points) {
      if (sharp.vertex == v) return false;
    }
    bool sharp = false;
    each_edge_at(t, QuadCorners{}, v,
                 [&](std::uint32_t corner, bool) { sharp |= t.sharpness[t.corner_edge[corner]] > 0; });
    if (sharp) return false;
  }
  return true;
}

// Of a regular patch. Its 4 × 4 points are the face's corners, in the middle, and the three vertices beyond
// each of them.
glm::dvec3 spline_at(const Topology& t, std::span<const glm::dvec3> points, glm::dvec2 at) {
  constexpr int kPlace[4][2] = {{1, 1}, {2, 1}, {2, 2}, {1, 2}};
  constexpr int kAlong[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};  // from corner k to corner k + 1
  const auto across = [&](std::uint32_t corner) {  // the same vertex, in the next face clockwise
    const auto& half = t.edges[t.corner_edge[corner]].half;
    return QuadCorners::next(half[half[0] == corner ? 1 : 0]);
  };
  glm::dvec3 grid[4][4];
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t opposite = across(across(k));
    const auto put = [&](int along, int side, std::uint32_t corner) {
      const int x = kPlace[k][0] - along * kAlong[k][0] + side * kAlong[k][1],
                y = kPlace[k][1] - along * kAlong[k][1] - side * kAlong[k][0];
      grid[y][x] = points[t.corners[corner]];
    };
    put(0, 0, k);
    put(1, 0, QuadCorners::next(opposite));
    put(1, 1, QuadCorners::next(QuadCorners::next(opposite)));
    put(0, 1, QuadCorners::previous(opposite));
  }
  const std::array<double, 4> u = spline_weights(at.x), v = spline_weights(at.y);
  glm::dvec3 sum(0);
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) sum += u[x] * v[y] * grid[y][x];
  }
  return sum;
}

}  // namespace

int child_at(glm::dvec2& at) {
  const glm::dvec2 p = 2.0 * at;
  const int child = at.x < 0.5 ? (at.y < 0.5 ? 0 : 3) : at.y < 0.5 ? 1 : 2;
  const glm::dvec2 places[] = {p, {p.y, 2 - p.x}, {2 - p.x, 2 - p.y}, {2 - p.y, p.x}};
  at = places[child];
  return child;
}

glm::dvec2 place_in_parent(int child, glm::dvec2 at) {
  const glm::dvec2 p = 0.5 * at;
  const glm::dvec2 places[] = {p, {1 - p.y, p.x}, {1 - p.x, 1 - p.y}, {p.y, 1 - p.x}};
  return places[child];
}

glm::dvec3 limit_at(const Topology& topology, std::span<const glm::dvec3> points, std::uint32_t face,
                    glm::dvec2 at) {
  assert(points.size() == topology.vertices && topology.uses.size() == topology.corners.size());
  const auto around = [](const Topology& t, std::span<const glm::dvec3> of, std::uint32_t f) {
    return with_corners(t, [&](const auto& walk) { return patch_around(t, walk, of, f); });
  };
  Patch patch = around(topology, points, face);
  for (int step = 0;; ++step) {
    // One refinement gives the patches of all children. The refined points on the patch's rim are
    // wrong, because the faces beyond it are missing; they are never among the points around a child.
    const Refinement refinement(patch.mesh, 1);
    const Topology& t = refinement.topology(0);
    if (is_regular(t)) return spline_at(t, patch.points, at);
    if (step == kMostSteps) {
      const std::vector<glm::dvec3> limits = limit_points(t, patch.points);
      const auto corner = [&](std::uint32_t k) { return limits[t.corners[k]]; };
      return (1 - at.y) * ((1 - at.x) * corner(0) + at.x * corner(1)) +
             at.y * ((1 - at.x) * corner(3) + at.x * corner(2));
    }
    const int child = child_at(at);
    patch = around(refinement.topology(1), standard_points(refinement, patch.points)[1],
                   static_cast<std::uint32_t>(child));
  }
}

}  // namespace terrabench::subdivision
