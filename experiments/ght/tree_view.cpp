#include "experiments/ght/tree_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

namespace terrabench::ght {
namespace {

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Tree& tree) : tree_(tree) {}
  void add(const Face& face) {
    NodeId node = 0;
    for (const CellId c : face) node = std::max(node, tree_.node_of(c));
    for (const CellId c : face) surface_.mesh.indices.push_back(vertex(c, node));
    surface_.nodes.push_back(node);
  }
  TreeSurface finish() {
    compute_normals(surface_.mesh);
    return std::move(surface_);
  }

 private:
  std::uint32_t vertex(CellId c, NodeId node) {
    const auto [at, added] =
        vertices_.try_emplace(static_cast<std::uint64_t>(node) << 32 | c,
                              static_cast<std::uint32_t>(surface_.mesh.positions.size()));
    if (added) surface_.mesh.positions.push_back(tree_.position(c));
    return at->second;
  }

  const Tree& tree_;
  TreeSurface surface_;
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;  // of a cell in a node's triangles
};

void add_quad(TriangleMesh& mesh, const std::array<glm::vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + k);
}

double turn(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  return static_cast<double>(b.x - a.x) * (c.y - a.y) - static_cast<double>(b.y - a.y) * (c.x - a.x);
}

// Of points sorted by x and then y (Andrew 1979).
std::vector<glm::ivec2> convex_hull(const std::vector<glm::ivec2>& points) {
  std::vector<glm::ivec2> hull;
  const auto add = [&](glm::ivec2 p, std::size_t fixed) {
    while (hull.size() >= fixed + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::ivec2 p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

}  // namespace

TreeSurface tree_surface(const Model& model) {
  SurfaceBuilder builder(model.tree);
  const SampleGrid& grid = model.tree.grid();
  for (int j = 0; j + 1 < grid.depth; ++j) {
    for (int i = 0; i + 1 < grid.width; ++i) {
      if (!model.surface.plain(model.tree, {i, j})) continue;
      for (const Face& face : ComposedSurface::plain_faces(ComposedSurface::corners(model.tree, {i, j})))
        builder.add(face);
    }
  }
  model.surface.each_face([&](FaceId f) { builder.add(model.surface.face(f)); });
  return builder.finish();
}

void cut_away(TriangleMesh& mesh, const CutPlane& plane, std::vector<NodeId>* nodes) {
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    const glm::vec3 a = mesh.positions[from], b = mesh.positions[to];
    const float share = plane.in_front(a) / (plane.in_front(a) - plane.in_front(b));
    mesh.positions.push_back(glm::mix(a, b, share));
    if (!mesh.normals.empty()) {
      mesh.normals.push_back(glm::normalize(glm::mix(mesh.normals[from], mesh.normals[to], share)));
    }
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  std::vector<std::uint32_t> kept, polygon;
  std::vector<NodeId> kept_nodes;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    polygon.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.indices[3 * t + k], b = mesh.indices[3 * t + (k + 1) % 3];
      const bool a_goes = plane.in_front(mesh.positions[a]) > 0,
                 b_goes = plane.in_front(mesh.positions[b]) > 0;
      if (!a_goes) polygon.push_back(a);
      if (a_goes != b_goes) polygon.push_back(add(a, b));
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      kept.insert(kept.end(), {polygon[0], polygon[k - 1], polygon[k]});
      if (nodes != nullptr) kept_nodes.push_back((*nodes)[t]);
    }
  }
  mesh.indices = std::move(kept);
  if (nodes != nullptr) *nodes = std::move(kept_nodes);
}

TriangleMesh section_face(const Ght& ght, const CutPlane& plane, float step) {
  const Bounds box = ght.bounds();
  const glm::vec2 along(plane.towards.y, -plane.towards.x);  // rightwards for who looks at the face
  const float reach = glm::length(glm::vec2(box.size().x, box.size().z));
  std::vector<float> x, z;
  for (float at = -reach; at <= reach; at += step) {
    const glm::vec2 p = plane.point + at * along;
    if (p.x < box.low.x || p.y < box.low.z || p.x > box.high.x || p.y > box.high.z) continue;
    x.push_back(p.x);
    z.push_back(p.y);
  }
  SpanSink sink;
  ght.spans({x, z}, sink);
  TriangleMesh mesh;
  const glm::vec2 half = 0.51F * step * along;  // strips overlap a little
  for (std::size_t c = 0; c < x.size(); ++c) {
    const glm::vec2 left = glm::vec2(x[c], z[c]) - half, right = glm::vec2(x[c], z[c]) + half;
    for (const Span& span : sink.column(c)) {
      add_quad(mesh, {glm::vec3(left.x, span.bottom, left.y), glm::vec3(right.x, span.bottom, right.y),
                      glm::vec3(right.x, span.top, right.y), glm::vec3(left.x, span.top, left.y)});
    }
  }
  return mesh;
}

TriangleMesh block_sides(const Ght& ght) {
  const Tree& tree = ght.model().tree;
  const SampleGrid& grid = tree.grid();
  const int last_i = grid.width - 1, last_j = grid.depth - 1;
  TriangleMesh mesh;
  // From a to b with the ground on the left, seen from above.
  const auto side = [&](Square a, Square b) {
    const glm::vec3 from = tree.position(tree.at_sample(a.i, a.j)),
                    to = tree.position(tree.at_sample(b.i, b.j));
    const float floor = ght.bounds().low.y;
    add_quad(mesh, {glm::vec3(from.x, floor, from.z), glm::vec3(to.x, floor, to.z), to, from});
  };
  for (int i = 0; i < last_i; ++i) {
    side({i, last_j}, {i + 1, last_j});
    side({i + 1, 0}, {i, 0});
  }
  for (int j = 0; j < last_j; ++j) {
    side({last_i, j + 1}, {last_i, j});
    side({0, j}, {0, j + 1});
  }
  return mesh;
}

std::vector<glm::vec3> plane_outline(const Tree& tree, NodeId n) {
  const GroundedHeightmap& node = tree.nodes()[n];
  std::vector<glm::ivec2> cells;
  for (int i = 0; i < node.columns; ++i) {
    int first = node.rows, last = -1;
    for (int j = 0; j < node.rows; ++j) {
      if (tree.kind(node.cell(i, j)) == CellKind::kVoid) continue;
      first = std::min(first, j);
      last = j;
    }
    if (last < 0) continue;
    cells.emplace_back(i, first);
    if (last > first) cells.emplace_back(i, last);
  }
  std::vector<glm::vec3> corners;
  if (cells.size() < 3) return corners;
  for (const glm::ivec2 c : convex_hull(cells)) {
    corners.push_back(node.aligned ? glm::vec3(tree.grid().x(node.i0 + c.x), 0, tree.grid().z(node.j0 + c.y))
                                   : glm::vec3(node.plane.at(c.x, c.y, 0)));
  }
  return corners;
}

}  // namespace terrabench::ght
