#include "representations/procedural_mesh/subdivision/topology.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "representations/procedural_mesh/subdivision/corner_walk.h"
#include "terrain/error.h"

namespace terrabench::subdivision {
namespace {

constexpr std::size_t kMostCorners = std::size_t{1} << 30;

std::string face_name(std::size_t f) { return fmt::format("face {}", f); }

void check_face(const FaceMesh& mesh, std::size_t f, std::vector<std::uint32_t>& sorted) {
  const std::uint32_t first = mesh.first_corner[f], last = mesh.first_corner[f + 1];
  if (last < first || last > mesh.corners.size()) {
    throw bad_input("the corners of a face lie outside the list of corners", face_name(f),
                    "first_corner must rise from 0 to the number of corners");
  }
  if (last - first < 3) {
    throw bad_input(fmt::format("a face has {} corners", last - first), face_name(f),
                    "give each face at least 3 corners");
  }
  sorted.assign(mesh.corners.begin() + first, mesh.corners.begin() + last);
  std::sort(sorted.begin(), sorted.end());
  if (sorted.back() >= mesh.positions.size()) {
    throw bad_input(fmt::format("a face uses vertex {} of {}", sorted.back(), mesh.positions.size()),
                    face_name(f), "vertices are counted from 0");
  }
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    throw bad_input(fmt::format("a face uses vertex {} twice", *twice), face_name(f),
                    "split the face, or merge its equal corners");
  }
}

void check_arrays(const FaceMesh& mesh) {
  if (mesh.corners.size() >= kMostCorners || mesh.positions.size() >= kMostCorners) {
    throw bad_input(
        fmt::format("a mesh of {} vertices and {} corners", mesh.positions.size(), mesh.corners.size()), "",
        fmt::format("keep both below {}", kMostCorners));
  }
  const bool ends = mesh.first_corner.empty()
                        ? mesh.corners.empty()
                        : mesh.first_corner.front() == 0 && mesh.first_corner.back() == mesh.corners.size();
  if (!ends) {
    throw bad_input("first_corner does not span the list of corners", "",
                    "it holds one number per face and the number of corners at its end");
  }
  std::vector<std::uint32_t> sorted;
  for (std::size_t f = 0; f < mesh.faces(); ++f) check_face(mesh, f, sorted);
}

[[noreturn]] void fail_at_edge(const Topology& t, std::uint32_t a, std::uint32_t b, std::size_t faces,
                               std::uint32_t c) {
  throw bad_input(faces > 2 ? fmt::format("the edge between vertices {} and {} has {} faces", a, b, faces)
                            : fmt::format("two faces run through the edge from vertex {} to {} in the same "
                                          "direction",
                                          a, b),
                  face_name(t.corner_face[c]),
                  faces > 2 ? "an edge has one face or two" : "turn one of the faces over");
}

// The corner on the other side of each corner's edge, or kNone.
template <class Walk>
Array<std::uint32_t> find_twins(const Topology& t, const Walk& walk) {
  struct Half {
    std::uint32_t high, corner;
  };
  const auto ends = [&](std::uint32_t c) { return std::minmax(t.corners[c], t.corners[walk.next(c)]); };
  std::vector<std::uint32_t> first(t.vertices + 2);
  const auto corners = static_cast<std::uint32_t>(t.corners.size());
  for (std::uint32_t c = 0; c < corners; ++c) ++first[ends(c).first + 2];
  for (std::uint32_t v = 0; v < t.vertices; ++v) first[v + 2] += first[v + 1];
  Array<Half> halves(corners);
  for (std::uint32_t c = 0; c < corners; ++c) {
    const auto [low, high] = ends(c);
    halves[first[low + 1]++] = {high, c};
  }
  tbb::parallel_for(0U, t.vertices, [&](std::uint32_t v) {
    std::sort(halves.begin() + first[v], halves.begin() + first[v + 1], [](const Half& a, const Half& b) {
      return a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
  });
  Array<std::uint32_t> twins(corners);
  for (std::uint32_t v = 0; v < t.vertices; ++v) {
    for (std::uint32_t i = first[v], j; i < first[v + 1]; i = j) {
      for (j = i + 1; j < first[v + 1] && halves[j].high == halves[i].high; ++j) {
      }
      const std::uint32_t c = halves[i].corner;
      twins[c] = kNone;
      if (j == i + 1) continue;
      const std::uint32_t d = halves[i + 1].corner;
      if (j > i + 2 || t.corners[c] == t.corners[d]) {
        fail_at_edge(t, t.corners[c], t.corners[walk.next(c)], j - i, d);
      }
      twins[c] = d;
      twins[d] = c;
    }
  }
  return twins;
}

// Edges in the order of their first corners, so that neighbours in the mesh are neighbours in memory.
void make_edges(Topology& t, const Array<std::uint32_t>& twins) {
  const auto corners = static_cast<std::uint32_t>(t.corners.size());
  t.corner_edge.resize(corners);
  t.edges.reserve(corners / 2 + 16);
  for (std::uint32_t c = 0; c < corners; ++c) {
    if (twins[c] < c) {
      t.corner_edge[c] = t.corner_edge[twins[c]];
      continue;
    }
    t.corner_edge[c] = static_cast<std::uint32_t>(t.edges.size());
    t.edges.push_back({{c, twins[c]}});
  }
  t.sharpness.resize(t.edges.size());
  for (std::size_t e = 0; e < t.edges.size(); ++e) {
    t.sharpness[e] = t.edges[e].half[1] == kNone ? kInfinitelySharp : 0;
  }
}

void make_uses(Topology& t) {
  t.first_use.assign(t.vertices + 1, 0);
  for (const std::uint32_t v : t.corners) ++t.first_use[v + 1];
  for (std::uint32_t v = 0; v < t.vertices; ++v) t.first_use[v + 1] += t.first_use[v];
  t.uses.resize(t.corners.size());
  Array<std::uint32_t> next(t.first_use.begin(), t.first_use.end());
  for (std::uint32_t c = 0; c < t.corners.size(); ++c) t.uses[next[t.corners[c]]++] = c;
}

void set_creases(Topology& t, std::span<const Crease> creases) {
  for (const Crease& crease : creases) {
    const std::string where = fmt::format("crease {}–{}", crease.a, crease.b);
    if (crease.sharpness < 0) {
      throw bad_input(fmt::format("sharpness {} of a crease", crease.sharpness), where, "use 0 or more");
    }
    const std::uint32_t edge = edge_between(t, crease.a, crease.b);
    if (edge == kNone) {
      throw bad_input("a crease is not an edge of the mesh", where, "name two neighbouring vertices");
    }
    const int sharpness = std::min(crease.sharpness, kInfinitelySharp);
    t.sharpness[edge] = static_cast<std::uint8_t>(std::max<int>(t.sharpness[edge], sharpness));
  }
}

// Whether the faces at v form one fan, open or closed.
template <class Walk>
bool one_fan(const Topology& t, const Walk& walk, std::uint32_t v) {
  const auto uses = t.uses_of(v);
  if (uses.empty()) return true;
  const auto twin = [&](std::uint32_t c) {
    const Edge& e = t.edges[t.corner_edge[c]];
    return e.half[0] == c ? e.half[1] : e.half[0];
  };
  std::uint32_t start = uses[0];
  for (const std::uint32_t c : uses) {
    if (twin(c) == kNone) start = c;
  }
  std::size_t met = 0;
  for (std::uint32_t c = start; c != kNone && met <= uses.size(); c = twin(walk.previous(c))) {
    if (c == start && met > 0) break;
    ++met;
  }
  return met == uses.size();
}

template <class Walk>
void set_sharp_points(Topology& t, const Walk& walk, const FaceMesh& mesh, Boundary boundary) {
  std::vector<SharpVertex>& points = t.sharp_points;
  for (const SharpVertex& point : mesh.sharp_vertices) {
    if (point.vertex >= t.vertices || point.sharpness < 0) {
      throw bad_input(fmt::format("sharpness {} of vertex {}", point.sharpness, point.vertex),
                      "sharp_vertices", fmt::format("use 0 or more, at a vertex below {}", t.vertices));
    }
    if (point.sharpness > 0) points.push_back({point.vertex, std::min(point.sharpness, kInfinitelySharp)});
  }
  for (std::uint32_t v = 0; v < t.vertices; ++v) {
    const auto uses = t.uses_of(v);
    const bool corner = boundary == Boundary::kEdgeAndCorner && uses.size() == 1;
    if (corner || !one_fan(t, walk, v)) points.push_back({v, kInfinitelySharp});
  }
  std::sort(points.begin(), points.end(), [](const SharpVertex& a, const SharpVertex& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.sharpness > b.sharpness;
  });
  const auto same = [](const SharpVertex& a, const SharpVertex& b) { return a.vertex == b.vertex; };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
}

}  // namespace

std::uint32_t edge_between(const Topology& t, std::uint32_t a, std::uint32_t b) {
  if (std::max(a, b) >= t.vertices) return kNone;
  return with_corners(t, [&](const auto& walk) {
    for (const std::uint32_t c : t.uses_of(a)) {
      const std::uint32_t before = walk.previous(c);
      if (t.corners[walk.next(c)] == b) return t.corner_edge[c];
      if (t.corners[before] == b) return t.corner_edge[before];
    }
    return kNone;
  });
}

Topology make_topology(const FaceMesh& mesh, Boundary boundary) {
  check_arrays(mesh);
  Topology t;
  t.vertices = static_cast<std::uint32_t>(mesh.positions.size());
  t.corners = mesh.corners;
  t.first_corner = mesh.first_corner;
  if (t.first_corner.empty()) t.first_corner = {0};
  t.corner_face.resize(t.corners.size());
  bool quads = true;
  for (std::uint32_t f = 0; f < t.faces(); ++f) {
    quads = quads && t.first_corner[f + 1] - t.first_corner[f] == 4;
    std::fill(t.corner_face.begin() + t.first_corner[f], t.corner_face.begin() + t.first_corner[f + 1], f);
  }
  const PolygonCorners walk{t.first_corner.data(), t.corner_face.data()};
  make_edges(t, find_twins(t, walk));
  make_uses(t);
  set_creases(t, mesh.creases);
  set_sharp_points(t, walk, mesh, boundary);
  if (quads) {
    release(t.first_corner);
    release(t.corner_face);
  }
  return t;
}

}  // namespace terrabench::subdivision
