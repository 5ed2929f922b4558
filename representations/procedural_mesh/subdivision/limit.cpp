#include "representations/procedural_mesh/subdivision/limit.h"

#include <algorithm>
#include <cassert>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/subdivision/catmull_clark.h"
#include "representations/procedural_mesh/subdivision/corner_walk.h"

namespace terrabench::subdivision {
namespace {

using Point = glm::dvec3;

// A vertex, the ends of its edges and the means of its faces. Refining the mesh maps such a ring to that of
// the same vertex, of the same form: face i lies between its edge `out[i]` and its edge `in[i]`.
struct Ring {
  Point vertex;
  int sharpness;  // of the vertex
  std::vector<Point> edges, faces;
  std::vector<int> edge_sharpness;
  std::vector<std::uint32_t> out, in;                          // per face
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;  // per edge, its faces; kNone on a boundary

  Point refined_vertex() const {
    Point along(0), sum(0);
    int sharp = 0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      sum += edges[e];
      if (edge_sharpness[e] == 0) continue;
      along += edges[e];
      ++sharp;
    }
    if (sharpness > 0 || sharp > 2) return vertex;
    if (sharp == 2) return vertex * 0.75 + along * 0.125;
    for (const Point& face : faces) sum += face;
    const RingWeights w = ring_weights(static_cast<std::uint32_t>(2 * faces.size()));
    return vertex * w.own + sum * w.ring;
  }

  void refine() {
    const Point next = refined_vertex();
    std::vector<Point> points(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
      points[e] = edge_sharpness[e] > 0
                      ? (vertex + edges[e]) * 0.5
                      : (vertex + edges[e] + faces[sides[e].first] + faces[sides[e].second]) * 0.25;
      edge_sharpness[e] = sharpness_after(edge_sharpness[e]);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
      faces[f] = (next + points[out[f]] + faces[f] + points[in[f]]) * 0.25;
    }
    edges = std::move(points);
    vertex = next;
    sharpness = sharpness_after(sharpness);
  }
};

template <class Walk>
class Limits {
 public:
  Limits(const Topology& t, const Walk& walk, std::span<const Point> in) : t_(t), walk_(walk), in_(in) {}

  Point at(std::uint32_t v, int vertex_sharpness) const {
    int sharp = 0, lasting = 0;
    Point along(0);
    each_edge_at(t_, walk_, v, [&](std::uint32_t c, bool outgoing) {
      const int s = t_.sharpness[t_.corner_edge[c]];
      sharp += s > 0;
      lasting += s >= kInfinitelySharp;
      if (s >= kInfinitelySharp) along += in_[t_.corners[outgoing ? walk_.next(c) : c]];
    });
    if (vertex_sharpness >= kInfinitelySharp || lasting > 2 || t_.uses_of(v).empty()) return in_[v];
    const bool constant = sharp == lasting && vertex_sharpness == 0;
    if (constant && sharp == 2) return (in_[v] * 4.0 + along) / 6.0;
    if (constant && sharp == 0) return smooth(v);
    return settled(ring_of(v, vertex_sharpness));
  }

 private:
  Point face_mean(std::uint32_t f) const {
    Point sum(0);
    for (std::uint32_t c = walk_.first(f); c < walk_.first(f + 1); ++c) sum += in_[t_.corners[c]];
    return sum / static_cast<double>(walk_.first(f + 1) - walk_.first(f));
  }

  Point smooth(std::uint32_t v) const {
    Point edges(0), faces(0);
    const auto uses = t_.uses_of(v);
    for (const std::uint32_t c : uses) {
      edges += in_[t_.corners[walk_.next(c)]];
      faces += face_mean(walk_.face(c));
    }
    const auto n = static_cast<double>(uses.size());
    return (in_[v] * (n * (n - 1)) + edges * 2.0 + faces * 4.0) / (n * (n + 5));
  }

  Ring ring_of(std::uint32_t v, int vertex_sharpness) const {
    Ring ring{in_[v], vertex_sharpness, {}, {}, {}, {}, {}, {}};
    std::vector<std::uint32_t> names;  // of the edges
    each_edge_at(t_, walk_, v, [&](std::uint32_t c, bool outgoing) {
      names.push_back(t_.corner_edge[c]);
      ring.edges.push_back(in_[t_.corners[outgoing ? walk_.next(c) : c]]);
      ring.edge_sharpness.push_back(t_.sharpness[t_.corner_edge[c]]);
      ring.sides.push_back({kNone, kNone});
    });
    for (const std::uint32_t c : t_.uses_of(v)) {
      const auto face = static_cast<std::uint32_t>(ring.faces.size());
      ring.faces.push_back(face_mean(walk_.face(c)));
      for (const std::uint32_t corner : {c, walk_.previous(c)}) {
        const auto e = static_cast<std::uint32_t>(
            std::find(names.begin(), names.end(), t_.corner_edge[corner]) - names.begin());
        (corner == c ? ring.out : ring.in).push_back(e);
        (ring.sides[e].first == kNone ? ring.sides[e].first : ring.sides[e].second) = face;
      }
    }
    return ring;
  }

  // A ring contracts to its limit by less than 0.66 per step at every valence (Halstead et al. 1993), once no
  // sharpness changes any more, and 0.66^100 is 1e-18.
  static Point settled(Ring ring) {
    for (int step = 0; step < 100 + kInfinitelySharp; ++step) ring.refine();
    return ring.vertex;
  }

  const Topology& t_;
  const Walk& walk_;
  std::span<const Point> in_;
};

}  // namespace

std::vector<Point> limit_points(const Topology& t, std::span<const Point> points) {
  assert(points.size() == t.vertices && t.uses.size() == t.corners.size());
  std::vector<Point> out(t.vertices);
  with_corners(t, [&](const auto& walk) {
    const Limits limits(t, walk, points);
    const auto less = [](const SharpVertex& a, std::uint32_t v) { return a.vertex < v; };
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, t.vertices, 1024), [&](const auto& range) {
      auto point = std::lower_bound(t.sharp_points.begin(), t.sharp_points.end(), range.begin(), less);
      for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
        const bool listed = point != t.sharp_points.end() && point->vertex == v;
        out[v] = limits.at(v, listed ? point++->sharpness : 0);
      }
    });
  });
  return out;
}

}  // namespace terrabench::subdivision
