// Steps among the corners of a topology: by arithmetic where all faces are quadrilaterals, by tables in a
// base mesh of polygons. And loops over its parts on all threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// Calls work(i) for 0 … count - 1 on all threads, in blocks that are worth a task.
template <class Work>
void for_all(std::uint32_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 4096), [&](const auto& range) {
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) work(i);
  });
}

struct QuadCorners {
  static std::uint32_t next(std::uint32_t c) { return (c & ~3U) | ((c + 1) & 3U); }
  static std::uint32_t previous(std::uint32_t c) { return (c & ~3U) | ((c + 3) & 3U); }
  static std::uint32_t face(std::uint32_t c) { return c >> 2; }
  static std::uint32_t first(std::uint32_t f) { return f * 4; }
};

struct PolygonCorners {
  const std::uint32_t* first_corner;
  const std::uint32_t* corner_face;
  std::uint32_t next(std::uint32_t c) const {
    return c + 1 == first_corner[face(c) + 1] ? first_corner[face(c)] : c + 1;
  }
  std::uint32_t previous(std::uint32_t c) const {
    return c == first_corner[face(c)] ? first_corner[face(c) + 1] - 1 : c - 1;
  }
  std::uint32_t face(std::uint32_t c) const { return corner_face[c]; }
  std::uint32_t first(std::uint32_t f) const { return first_corner[f]; }
};

// Calls work(walk), compiled once for quadrilaterals and once for polygons.
template <class Work>
decltype(auto) with_corners(const Topology& t, const Work& work) {
  if (t.first_corner.empty()) return work(QuadCorners{});
  return work(PolygonCorners{t.first_corner.data(), t.corner_face.data()});
}

// Calls visit(corner, outgoing) for each edge at v once: `corner` names the edge, which leaves v when
// `outgoing`, and arrives at it otherwise (a boundary edge).
template <class Walk, class Visit>
void each_edge_at(const Topology& t, const Walk& walk, std::uint32_t v, const Visit& visit) {
  for (const std::uint32_t c : t.uses_of(v)) {
    visit(c, true);
    const std::uint32_t in = walk.previous(c);
    if (t.edges[t.corner_edge[in]].half[1] == kNone) visit(in, false);
  }
}

}  // namespace terrabench::subdivision
