#include "representations/ght/surgery.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "representations/ght/triangulate.h"

namespace terrabench::ght {

NodeIndex::NodeIndex(const Lattice& lattice)
    : tiles_x_((static_cast<std::size_t>(std::max(lattice.width - 1, 1)) + kSide - 1) / kSide) {
  first_.assign(tiles_x_ * ((static_cast<std::size_t>(std::max(lattice.depth - 1, 1)) + kSide - 1) / kSide),
                kNone);
}

std::size_t NodeIndex::tiles(const SquareRange& r) {
  return static_cast<std::size_t>(r.i1 / kSide - r.i0 / kSide + 1) *
         static_cast<std::size_t>(r.j1 / kSide - r.j0 / kSide + 1);
}

void NodeIndex::add(const SquareRange& r, NodeId node) noexcept {
  for (int j = r.j0 / kSide; j <= r.j1 / kSide; ++j) {
    for (int i = r.i0 / kSide; i <= r.i1 / kSide; ++i) {
      std::uint32_t& first = first_[tile({i * kSide, j * kSide})];
      entries_.push_back({node, first});
      first = static_cast<std::uint32_t>(entries_.size() - 1);
    }
  }
}

Memory NodeIndex::memory() const {
  Memory memory = index_memory(first_);
  memory += index_memory(entries_);
  return memory;
}

Model::Model(Tree t, float lowest, float highest)
    : tree(std::move(t)), surface(tree.lattice()), index(tree.lattice()), floor(lowest), ceiling(highest) {}

void Model::index_node(NodeId n) {
  const SquareRange r = range(surface, tree.lattice(), tree.nodes()[n]);
  index.prepare(NodeIndex::tiles(r));
  index.add(r, n);
}

void boundary_links(const Model& model, CellId c, std::vector<CellId>& out) {
  const Tree& tree = model.tree;
  const NodeId own = tree.node_of(c);
  const auto add = [&](std::span<const CellId> corners) {
    if (std::find(corners.begin(), corners.end(), c) == corners.end()) return;
    for (const CellId other : corners) {
      if (tree.node_of(other) != own) out.push_back(other);
    }
  };
  out.clear();
  const glm::dvec2 p = tree.plan(c);
  const SquareRange r = model.surface.range(p, p);
  for (int j = r.j0; j <= r.j1; ++j) {
    for (int i = r.i0; i <= r.i1; ++i) {
      if (model.surface.plain(tree, {i, j})) {
        for (const Face& face : Surface::plain_faces(Surface::corners(tree, {i, j}))) add(face);
      }
      model.surface.over({i, j}, [&](FaceId f) { add(model.surface.face(f)); });
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

SquareRange range(const Surface& surface, const Lattice& lattice, const Node& node) {
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const int j : {0, node.rows - 1}) {
    for (const int i : {0, node.columns - 1}) {
      const glm::dvec3 p = node.aligned ? glm::dvec3(lattice.x(node.i0 + i), 0, lattice.z(node.j0 + j))
                                        : node.frame.at(i, j, 0);
      low = glm::min(low, glm::dvec2(p.x, p.z));
      high = glm::max(high, glm::dvec2(p.x, p.z));
    }
  }
  return surface.range(low, high);
}

void Edit::remove(const Cut& cut) {
  covered_.insert(covered_.end(), cut.squares.begin(), cut.squares.end());
  removed_.insert(removed_.end(), cut.faces.begin(), cut.faces.end());
}

void Edit::quad(std::array<CellId, 4> corners) {
  std::array<CellId, 4> c;
  std::size_t n = 0;
  for (const CellId corner : corners) {
    const CellId cell = tree().resolve(corner);
    if (tree().kind(cell) == CellKind::kVoid || std::find(c.begin(), c.begin() + n, cell) != c.begin() + n)
      continue;
    c[n++] = cell;
  }
  if (n < 3) return;
  if (n == 3) return face(c[0], c[1], c[2]);
  const auto length = [&](CellId a, CellId b) {
    const glm::vec3 along = tree().position(b) - tree().position(a);
    return glm::dot(along, along);
  };
  const std::size_t start = length(c[0], c[2]) <= length(c[1], c[3]) ? 0 : 1;  // the shorter diagonal
  face(c[start], c[start + 1], c[start + 2]);
  face(c[start], c[start + 2], c[(start + 3) % 4]);
}

void Edit::quads(const Node& node, bool mirrored) {
  for (int j = 0; j + 1 < node.rows; ++j) {
    for (int i = 0; i + 1 < node.columns; ++i) {
      std::array<CellId, 4> c = {node.cell(i, j), node.cell(i + 1, j), node.cell(i + 1, j + 1),
                                 node.cell(i, j + 1)};
      if (mirrored) std::swap(c[1], c[3]);
      quad(c);
    }
  }
}

void Edit::close_ring(std::span<const CellId> loop, std::span<const CellId> outline) {
  std::vector<glm::dvec2> outer, inner;
  for (const CellId c : loop) outer.push_back(map_point(tree().position(c)));
  for (const CellId c : outline) inner.push_back(map_point(tree().position(c)));
  const auto cell = [&](std::uint32_t k) { return k < loop.size() ? loop[k] : outline[k - loop.size()]; };
  // Cells of one loop may be joined already by faces that lie over or upright next to the ring.
  std::vector<std::pair<CellId, CellId>> joined;
  const auto join = [&](const Face& face) {
    for (std::size_t k = 0; k < 3; ++k) joined.push_back(std::minmax({face[k], face[(k + 1) % 3]}));
  };
  for (const Face& face : faces_) join(face);
  std::vector<FaceId> removed = removed_, left;
  std::sort(removed.begin(), removed.end());
  for (const CellId c : loop) {
    const glm::dvec2 p = tree().plan(c);
    const SquareRange r = model_.surface.range(p, p);
    model_.surface.over({r.i0, r.j0}, [&](FaceId f) {
      if (!std::binary_search(removed.begin(), removed.end(), f)) left.push_back(f);
    });
  }
  for (const FaceId f : left) join(model_.surface.face(f));
  std::sort(joined.begin(), joined.end());
  const auto triangles = triangulate_ring(outer, inner, [&](std::uint32_t a, std::uint32_t b) {
    return std::binary_search(joined.begin(), joined.end(), std::pair(std::minmax({cell(a), cell(b)})));
  });
  if (!triangles)
    refusal_.refuse("does not fit to the ground around it", "move the event, or make it smaller");
  for (const Triangle& t : *triangles) face(cell(t[0]), cell(t[1]), cell(t[2]));
  check_linked(outline);
}

void Edit::check_linked(std::span<const CellId> outline) const {
  std::vector<CellId> linked;
  for (const Face& face : faces_) {
    const std::array nodes = {model_.tree.node_of(face[0]), model_.tree.node_of(face[1]),
                              model_.tree.node_of(face[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      if (nodes[k] != nodes[(k + 1) % 3] || nodes[k] != nodes[(k + 2) % 3]) linked.push_back(face[k]);
    }
  }
  std::sort(linked.begin(), linked.end());
  for (const CellId c : outline) {
    if (!std::binary_search(linked.begin(), linked.end(), c))
      refusal_.refuse("does not fit to the ground around it", "move the event, or make it smaller");
  }
}

void Edit::keep_clear_of_carvings() const {
  if (!model_.carved) return;
  const Tree& tree = model_.tree;
  const float clearance = tree.lattice().cell();
  std::vector<Crossing> below;
  for (std::size_t n = nodes_before_; n < tree.nodes().size(); ++n) {
    const Node& node = tree.nodes()[n];
    for (CellId c = node.first; c < node.first + node.cells(); ++c) {
      if (tree.kind(c) != CellKind::kHeight) continue;
      const glm::vec3 p = tree.position(c);
      Square s;
      if (!model_.surface.find(p.x, p.z, s)) continue;
      below.clear();
      model_.surface.crossings(tree, p.x, p.z, s, below);
      // A carving's roof is the highest way out of the ground: nothing else here lies over itself.
      for (const Crossing& roof : below) {
        if (roof.weight < 0 && roof.y + clearance > p.y) {
          refusal_.refuse("breaks into a tunnel or cave below", "make it shallower, or move it");
        }
      }
    }
  }
}

void Edit::check_faces() const {
  for (const Face& face : faces_) {
    if (model_.surface.range(model_.tree, face).count() > Surface::kMostSquares) {
      refusal_.refuse("leaves a gap that is too wide to close", "move the event, or make it smaller");
    }
  }
}

void Edit::commit(events::Kind kind, NodeId host) {
  Tree& tree = model_.tree;
  check_faces();
  model_.surface.prepare(tree, covered_, faces_);
  const auto indexed = [&](const Node& node) { return node.area == Area::kOutdoor; };
  std::size_t tiles = 0;
  for (std::size_t n = nodes_before_; n < tree.nodes().size(); ++n) {
    const Node& node = tree.nodes()[n];
    if (indexed(node)) tiles += NodeIndex::tiles(range(model_.surface, tree.lattice(), node));
  }
  model_.index.prepare(tiles);
  tree.reserve_event();
  float lowest = HUGE_VALF, highest = -HUGE_VALF;
  for (CellId c = tree.nodes()[nodes_before_].first; c < tree.cells(); ++c) {
    if (tree.kind(c) != CellKind::kHeight) continue;
    const float y = tree.position(c).y;
    lowest = std::min(lowest, y);
    highest = std::max(highest, y);
  }

  // From here on nothing fails. Faces are found by where their cells are, so they go before the cells change.
  for (const FaceId f : removed_) model_.surface.remove(tree, f);
  for (const Link& link : links_) tree.set_link(link.from, link.to);
  for (const Square s : covered_) model_.surface.set_covered(s, true);
  for (const Square s : plain_) model_.surface.set_covered(s, false);
  for (const Face& face : faces_) model_.surface.add(tree, face);
  for (std::size_t n = nodes_before_; n < tree.nodes().size(); ++n) {
    const Node& node = tree.nodes()[n];
    if (indexed(node)) model_.index.add(range(model_.surface, tree.lattice(), node), static_cast<NodeId>(n));
  }
  tree.append(Applied{kind, host, static_cast<NodeId>(nodes_before_),
                      static_cast<NodeId>(tree.nodes().size() - nodes_before_)});
  if (lowest <= model_.floor) model_.floor = lowest - tree.lattice().cell();
  model_.ceiling = std::max(model_.ceiling, highest);
  model_.carved = model_.carved || is_carving(kind);
  committed_ = true;
}

}  // namespace terrabench::ght
