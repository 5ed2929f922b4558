#include "representations/procedural_mesh/subdivision/refine.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>

#include "representations/procedural_mesh/subdivision/corner_walk.h"

namespace terrabench::subdivision {
namespace {

// Calls work(i) for 0 … count - 1 on all threads, in blocks that are worth a task.
template <class Work>
void for_all(std::uint32_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 4096), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) work(i);
  });
}

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

}  // namespace terrabench::subdivision
