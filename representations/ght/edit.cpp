#include "representations/ght/edit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "representations/ght/loops.h"
#include "representations/ght/triangulate.h"
#include "terrain/error.h"

namespace terrabench::ght {
namespace {

constexpr std::string_view kNoFit = "does not fit the ground around it";

}  // namespace

void Edit::refuse(std::string_view what, std::string_view advice) const {
  throw bad_input(what, where_, advice);
}

float Edit::ground(glm::dvec2 plan) const {
  const float y = model_.surface.top(tree(), plan);
  if (Heightfield::is_no_data(y)) refuse(kNoData, kFillNoData);
  return y;
}

void Edit::remove(std::span<const Square> squares, std::span<const FaceId> faces) {
  covered_.insert(covered_.end(), squares.begin(), squares.end());
  removed_.insert(removed_.end(), faces.begin(), faces.end());
}

GroundedHeightmap Edit::append(GroundedHeightmap heightmap) {
  heightmap.parent = host_;
  heightmap.event = static_cast<std::uint32_t>(tree().events().size());
  return tree().nodes()[model_.tree.append(heightmap)];
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

void Edit::quads(const GroundedHeightmap& node, bool mirrored) {
  for (int j = 0; j + 1 < node.rows; ++j) {
    for (int i = 0; i + 1 < node.columns; ++i) {
      std::array<CellId, 4> c = {node.cell(i, j), node.cell(i + 1, j), node.cell(i + 1, j + 1),
                                 node.cell(i, j + 1)};
      if (mirrored) std::swap(c[1], c[3]);
      quad(c);
    }
  }
}

// Pairs of cells that are already an edge of a face: of a new one, or of an old one that stays near the loop.
// The ring must not use such an edge again.
std::vector<std::pair<CellId, CellId>> Edit::joined_cells(std::span<const CellId> loop) const {
  std::vector<std::pair<CellId, CellId>> joined;
  const auto join = [&](const Face& face) {
    for (std::size_t k = 0; k < 3; ++k) joined.push_back(std::minmax({face[k], face[(k + 1) % 3]}));
  };
  for (const Face& face : faces_) join(face);
  std::vector<FaceId> removed = removed_;
  std::sort(removed.begin(), removed.end());
  for (const CellId c : loop) {
    const glm::dvec2 p = tree().plan(c);
    const SquareRange r = model_.surface.range(p, p);
    model_.surface.over({r.i0, r.j0}, [&](FaceId f) {
      if (!std::binary_search(removed.begin(), removed.end(), f)) join(model_.surface.face(f));
    });
  }
  std::sort(joined.begin(), joined.end());
  return joined;
}

void Edit::close_ring(std::span<const CellId> loop, std::span<const CellId> outline) {
  const auto cell = [&](std::uint32_t k) { return k < loop.size() ? loop[k] : outline[k - loop.size()]; };
  const std::vector<std::pair<CellId, CellId>> joined = joined_cells(loop);
  const auto triangles = triangulate_ring(
      map_points(tree(), loop), map_points(tree(), outline), [&](std::uint32_t a, std::uint32_t b) {
        return std::binary_search(joined.begin(), joined.end(), std::pair(std::minmax({cell(a), cell(b)})));
      });
  if (!triangles) refuse(kNoFit, kMove);
  for (const Triangle& t : *triangles) face(cell(t[0]), cell(t[1]), cell(t[2]));
  check_joined(outline);
}

void Edit::check_joined(std::span<const CellId> outline) const {
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
    if (!std::binary_search(linked.begin(), linked.end(), c)) refuse(kNoFit, kMove);
  }
}

void Edit::keep_clear_of_carvings() const {
  if (!model_.carved) return;
  const Tree& tree = model_.tree;
  const float clearance = tree.grid().spacing();
  std::vector<Crossing> below;
  for (std::size_t n = nodes_before_; n < tree.nodes().size(); ++n) {
    const GroundedHeightmap& node = tree.nodes()[n];
    for (CellId c = node.first; c < node.first + node.cells(); ++c) {
      if (tree.kind(c) != CellKind::kHeight) continue;
      const glm::vec3 p = tree.position(c);
      Square s;
      if (!model_.surface.find(p.x, p.z, s)) continue;
      below.clear();
      model_.surface.crossings(tree, p.x, p.z, s, below);
      // Weight -1 is the roof of a carving: other ground that lies over itself has been refused.
      for (const Crossing& roof : below) {
        if (roof.weight < 0 && roof.y + clearance > p.y) {
          refuse("breaks into a tunnel or cave below", "make it shallower, or move it");
        }
      }
    }
  }
}

void Edit::check_faces() const {
  for (const Face& face : faces_) {
    if (model_.surface.range(model_.tree, face).count() > ComposedSurface::kMostSquares) {
      refuse("leaves a gap that is too wide to close", kMove);
    }
  }
}

Edit::Prepared Edit::prepare() {
  check_faces();
  model_.surface.prepare(tree(), covered_, faces_);
  Prepared made{model_.surface.place(tree(), faces_),
                std::vector<FaceId>(faces_.size()),
                {},
                {},
                HUGE_VALF,
                -HUGE_VALF};
  std::size_t tiles = 0;
  each_outdoor([&](NodeId, const auto& range) { tiles += NodeIndex::tiles(range); });
  model_.index.prepare(tiles);
  made.superseded.reserve(superseded_.size());
  for (const auto& [old, by] : superseded_) made.superseded.push_back(old);
  std::sort(made.superseded.begin(), made.superseded.end());
  made.rim = rim_change(model_, covered_, removed_, made.superseded, faces_, first_new());
  model_.links.prepare(made.rim.most);
  model_.tree.reserve_event();
  for (CellId c = tree().nodes()[first_new()].first; c < tree().cells(); ++c) {
    if (tree().kind(c) != CellKind::kHeight) continue;
    const float y = tree().position(c).y;
    made.lowest = std::min(made.lowest, y);
    made.highest = std::max(made.highest, y);
  }
  return made;
}

// Nothing fails here. The new nodes are in the tree already; of the tree, only the superseded cells and the
// list of events change, the rest is surface and index. Faces are found by the places of their cells, so they
// are removed before the cells change.
void Edit::apply(events::Kind kind, Prepared made) {
  Tree& tree = model_.tree;
  for (const FaceId f : removed_) model_.surface.remove(tree, f);
  for (const auto& [old, by] : superseded_) tree.set_link(old, by);
  for (const Square s : covered_) model_.surface.set_covered(s, true);
  for (const Square s : plain_) model_.surface.set_covered(s, false);
  model_.surface.add(faces_, made.placed, made.ids);
  relink(model_, made.rim, made.superseded, faces_, first_new());
  each_outdoor([&](NodeId n, const auto& range) { model_.index.add(range, n); });
  tree.append(Applied{kind, host_, first_new(), static_cast<NodeId>(tree.nodes().size() - nodes_before_)});
  if (made.lowest <= model_.floor) model_.floor = made.lowest - tree.grid().spacing();
  model_.ceiling = std::max(model_.ceiling, made.highest);
  model_.carved = model_.carved || is_carving(kind);
  committed_ = true;
}

}  // namespace terrabench::ght
