#include "representations/procedural_mesh/subdivision/catmull_clark.h"

#include <algorithm>
#include <cassert>
#include <glm/glm.hpp>

#include "representations/procedural_mesh/subdivision/corner_walk.h"

namespace terrabench::subdivision {
namespace {

struct Sizes {
  std::uint32_t vertices, faces, edges, corners;
  explicit Sizes(const Topology& t)
      : vertices(t.vertices),
        faces(t.faces()),
        edges(static_cast<std::uint32_t>(t.edges.size())),
        corners(static_cast<std::uint32_t>(t.corners.size())) {}
  std::uint32_t face_point(std::uint32_t f) const { return vertices + f; }
  std::uint32_t edge_point(std::uint32_t e) const { return vertices + faces + e; }
};

// The child's quadrilaterals. Each edge splits in two, 2e from its first end and 2e + 1 to its second; edge
// 2E + c joins the point of c's edge to that of c's face.
template <class Walk>
void make_quads(const Topology& t, const Walk& walk, Detail detail, Topology& child) {
  const Sizes n(t);
  child.corners.resize(std::size_t{n.corners} * 4);
  if (detail == Detail::kAll) child.corner_edge.resize(child.corners.size());
  for_all(n.corners, [&](std::uint32_t c) {
    const std::uint32_t before = walk.previous(c), e = t.corner_edge[c], d = t.corner_edge[before];
    std::uint32_t* quad = &child.corners[std::size_t{c} * 4];
    quad[0] = t.corners[c];
    quad[1] = n.edge_point(e);
    quad[2] = n.face_point(walk.face(c));
    quad[3] = n.edge_point(d);
    if (detail != Detail::kAll) return;
    std::uint32_t* edges = &child.corner_edge[std::size_t{c} * 4];
    edges[0] = 2 * e + (t.edges[e].half[0] == c ? 0 : 1);
    edges[1] = 2 * n.edges + c;
    edges[2] = 2 * n.edges + before;
    edges[3] = 2 * d + (t.edges[d].half[0] == before ? 1 : 0);
  });
}

template <class Walk>
void make_edges(const Topology& t, const Walk& walk, Topology& child) {
  const Sizes n(t);
  child.edges.resize(std::size_t{n.edges} * 2 + n.corners);
  child.sharpness.resize(child.edges.size());
  for_all(n.edges, [&](std::uint32_t e) {
    const std::uint32_t a = t.edges[e].half[0], b = t.edges[e].half[1];
    const bool border = b == kNone;
    child.edges[2 * e] = {{4 * a, border ? kNone : 4 * walk.next(b) + 3}};
    child.edges[2 * e + 1] = {{4 * walk.next(a) + 3, border ? kNone : 4 * b}};
    child.sharpness[2 * e] = child.sharpness[2 * e + 1] =
        static_cast<std::uint8_t>(sharpness_after(t.sharpness[e]));
  });
  for_all(n.corners, [&](std::uint32_t c) {
    child.edges[2 * n.edges + c] = {{4 * c + 1, 4 * walk.next(c) + 2}};
    child.sharpness[2 * n.edges + c] = 0;
  });
}

template <class Walk>
void make_uses(const Topology& t, const Walk& walk, Topology& child) {
  const Sizes n(t);
  child.first_use.resize(std::size_t{child.vertices} + 1);
  child.uses.resize(child.corners.size());
  std::copy(t.first_use.begin(), t.first_use.end(), child.first_use.begin());
  for_all(n.faces, [&](std::uint32_t f) { child.first_use[n.face_point(f)] = n.corners + walk.first(f); });
  std::uint32_t next = 2 * n.corners;
  for (std::uint32_t e = 0; e < n.edges; ++e) {
    child.first_use[n.edge_point(e)] = next;
    next += t.edges[e].half[1] == kNone ? 2 : 4;
  }
  child.first_use[child.vertices] = next;
  for_all(n.corners, [&](std::uint32_t i) {
    child.uses[i] = 4 * t.uses[i];
    child.uses[n.corners + i] = 4 * i + 2;
  });
  for_all(n.edges, [&](std::uint32_t e) {
    std::uint32_t* uses = &child.uses[child.first_use[n.edge_point(e)]];
    for (const std::uint32_t half : t.edges[e].half) {
      if (half == kNone) continue;
      *uses++ = 4 * half + 1;
      *uses++ = 4 * walk.next(half) + 3;
    }
  });
}

// The number of entries in v's ring, by its sharp edges.
template <class Walk>
std::uint32_t ring_size(const Topology& t, const Walk& walk, std::uint32_t v) {
  int sharp = 0;
  each_edge_at(t, walk, v, [&](std::uint32_t c, bool) { sharp += t.sharpness[t.corner_edge[c]] > 0; });
  return sharp > 2 ? 0 : sharp == 2 ? 2 : 2 * (t.first_use[v + 1] - t.first_use[v]);
}

template <class Walk>
void fill_ring(const Topology& t, const Walk& walk, std::uint32_t v, std::span<std::uint32_t> ring) {
  std::size_t i = 0;
  if (ring.size() == 2) {
    each_edge_at(t, walk, v, [&](std::uint32_t c, bool outgoing) {
      if (t.sharpness[t.corner_edge[c]] > 0) ring[i++] = t.corners[outgoing ? walk.next(c) : c];
    });
  } else if (!ring.empty()) {
    for (const std::uint32_t c : t.uses_of(v)) {
      ring[i++] = t.corners[walk.next(c)];
      ring[i++] = t.vertices + walk.face(c);
    }
  }
}

template <class Walk>
void make_rings(const Topology& t, const Walk& walk, Stencils& s) {
  s.first_ring.resize(std::size_t{t.vertices} + 1);
  for_all(t.vertices, [&](std::uint32_t v) { s.first_ring[v] = ring_size(t, walk, v); });
  for (const SharpVertex& point : t.sharp_points) s.first_ring[point.vertex] = 0;
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < t.vertices; ++v) {
    const std::uint32_t size = s.first_ring[v];
    s.longest_ring = std::max(s.longest_ring, size);
    s.first_ring[v] = next;
    next += size;
  }
  s.first_ring[t.vertices] = next;
  s.rings.resize(next);
  for_all(t.vertices, [&](std::uint32_t v) {
    fill_ring(t, walk, v, {s.rings.data() + s.first_ring[v], s.first_ring[v + 1] - s.first_ring[v]});
  });
}

}  // namespace

std::uint32_t child_vertices(const Topology& t) {
  return t.vertices + t.faces() + static_cast<std::uint32_t>(t.edges.size());
}

Topology refine(const Topology& t, Detail detail) {
  assert(t.corners.size() <= (std::size_t{1} << 28));
  Topology child;
  child.vertices = child_vertices(t);
  with_corners(t, [&](const auto& walk) {
    make_quads(t, walk, detail, child);
    if (detail != Detail::kCorners) make_uses(t, walk, child);
    if (detail == Detail::kAll) make_edges(t, walk, child);
  });
  for (const SharpVertex& point : t.sharp_points) {
    const int sharpness = sharpness_after(point.sharpness);
    if (sharpness > 0) child.sharp_points.push_back({point.vertex, sharpness});
  }
  return child;
}

Stencils make_stencils(const Topology& t) {
  Stencils s;
  s.edges.resize(t.edges.size() * 4);
  with_corners(t, [&](const auto& walk) {
    for_all(static_cast<std::uint32_t>(t.edges.size()), [&](std::uint32_t e) {
      const std::uint32_t c = t.edges[e].half[0], d = t.edges[e].half[1];
      std::uint32_t* parents = &s.edges[std::size_t{e} * 4];
      parents[0] = t.corners[c];
      parents[1] = t.corners[walk.next(c)];
      const bool sharp = t.sharpness[e] > 0;
      parents[2] = sharp ? parents[0] : t.vertices + walk.face(c);
      parents[3] = sharp ? parents[1] : t.vertices + walk.face(d);
    });
    make_rings(t, walk, s);
  });
  return s;
}

namespace {

template <class T>
using Scalar = typename T::value_type;

template <class T>
void place_faces(const Topology& t, const T* in, T* out) {
  const std::uint32_t* const corners = t.corners.data();
  if (t.first_corner.empty()) {
    for_all(t.faces(), [=](std::uint32_t f) {
      const std::uint32_t* const c = corners + std::size_t{f} * 4;
      out[f] = ((in[c[0]] + in[c[1]]) + (in[c[2]] + in[c[3]])) * Scalar<T>(0.25);
    });
    return;
  }
  for_all(t.faces(), [&](std::uint32_t f) {
    T sum(0);
    for (std::uint32_t c = t.first_corner[f]; c < t.first_corner[f + 1]; ++c) sum += in[corners[c]];
    out[f] = sum * (1 / static_cast<Scalar<T>>(t.first_corner[f + 1] - t.first_corner[f]));
  });
}

// A ring entry below `vertices` is a vertex of the coarser mesh, one above it a face point.
template <class T>
void place_edges(const Stencils& s, std::uint32_t vertices, const T* in, const T* points, T* out) {
  const std::uint32_t* const parents = s.edges.data();
  for_all(static_cast<std::uint32_t>(s.edges.size() / 4), [=](std::uint32_t e) {
    const std::uint32_t* const p = parents + std::size_t{e} * 4;
    const T* const from = p[2] < vertices ? in : points;  // a sharp edge has its ends twice
    out[e] = ((in[p[0]] + in[p[1]]) + (from[p[2]] + from[p[3]])) * Scalar<T>(0.25);
  });
}

template <class T>
void place_vertices(const Stencils& s, std::uint32_t vertices, const T* in, const T* points, T* out) {
  struct Weights {
    Scalar<T> own, ring;
  };
  std::vector<Weights> weights;
  for (std::uint32_t count = 0; count <= s.longest_ring; ++count) {
    const RingWeights w = ring_weights(count);
    weights.push_back({static_cast<Scalar<T>>(w.own), static_cast<Scalar<T>>(w.ring)});
  }
  for_all(vertices, [&, rings = s.rings.data(), first = s.first_ring.data()](std::uint32_t v) {
    const std::uint32_t* const p = rings + first[v];
    const std::uint32_t count = first[v + 1] - first[v];
    const Weights w = weights[count];
    T sum(0);
    if (count == 8) {
      sum = ((in[p[0]] + in[p[2]]) + (in[p[4]] + in[p[6]])) +
            ((points[p[1]] + points[p[3]]) + (points[p[5]] + points[p[7]]));
    } else if (count == 2) {
      sum = in[p[0]] + in[p[1]];
    } else {
      for (std::uint32_t i = 0; i < count; i += 2) sum += in[p[i]] + points[p[i + 1]];
    }
    out[v] = in[v] * w.own + sum * w.ring;
  });
}

}  // namespace

template <class T>
void place_standard(const Topology& t, const Stencils& s, std::span<const T> in, std::span<T> out) {
  assert(in.size() == t.vertices && out.size() == t.vertices + t.faces() + s.edges.size() / 4);
  place_faces(t, in.data(), out.data() + t.vertices);
  place_edges(s, t.vertices, in.data(), out.data(), out.data() + t.vertices + t.faces());
  place_vertices(s, t.vertices, in.data(), out.data(), out.data());
}

template <class T>
void place_linear(const Topology& t, const Stencils& s, std::span<const T> in, std::span<T> out) {
  assert(in.size() == t.vertices && out.size() == t.vertices + t.faces() + s.edges.size() / 4);
  place_faces(t, in.data(), out.data() + t.vertices);
  std::copy(in.begin(), in.end(), out.begin());
  T* const edges = out.data() + t.vertices + t.faces();
  for_all(static_cast<std::uint32_t>(s.edges.size() / 4), [&](std::uint32_t e) {
    const std::uint32_t* const ends = &s.edges[std::size_t{e} * 4];
    edges[e] = (in[ends[0]] + in[ends[1]]) * Scalar<T>(0.5);
  });
}

#define TERRABENCH_INSTANTIATE(T)                                                                      \
  template void place_standard<T>(const Topology&, const Stencils&, std::span<const T>, std::span<T>); \
  template void place_linear<T>(const Topology&, const Stencils&, std::span<const T>, std::span<T>)
TERRABENCH_INSTANTIATE(glm::vec2);
TERRABENCH_INSTANTIATE(glm::vec3);
TERRABENCH_INSTANTIATE(glm::dvec3);
#undef TERRABENCH_INSTANTIATE

}  // namespace terrabench::subdivision
