#include "experiments/ght/tree_view.h"

#include <algorithm>
#include <glm/vec2.hpp>
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
  const Lattice& lattice = model.tree.lattice();
  for (int j = 0; j + 1 < lattice.depth; ++j) {
    for (int i = 0; i + 1 < lattice.width; ++i) {
      if (!model.surface.plain(model.tree, {i, j})) continue;
      for (const Face& face : Surface::plain_faces(Surface::corners(model.tree, {i, j}))) builder.add(face);
    }
  }
  model.surface.each_face([&](FaceId f) { builder.add(model.surface.face(f)); });
  return builder.finish();
}

std::vector<glm::vec3> plane_outline(const Tree& tree, NodeId n) {
  const Node& node = tree.nodes()[n];
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
    corners.push_back(node.aligned
                          ? glm::vec3(tree.lattice().x(node.i0 + c.x), 0, tree.lattice().z(node.j0 + c.y))
                          : glm::vec3(node.frame.at(c.x, c.y, 0)));
  }
  return corners;
}

}  // namespace terrabench::ght
