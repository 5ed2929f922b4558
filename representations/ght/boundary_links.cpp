#include "representations/ght/boundary_links.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "representations/ght/model.h"

namespace terrabench::ght {
namespace {

// The samples around one that an edge of a plain square can join to it.
constexpr Square kJoined[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};

// Whether a cell of an aligned heightmap holds a height and one of those around it does not.
bool at_rim(const Tree& tree, const GroundedHeightmap& node, int i, int j) {
  if (tree.kind(node.cell(i, j)) != CellKind::kHeight) return false;
  return std::any_of(std::begin(kJoined), std::end(kJoined), [&](Square by) {
    const int a = i + by.i, b = j + by.j;
    return a < 0 || b < 0 || a >= node.columns || b >= node.rows ||
           tree.kind(node.cell(a, b)) != CellKind::kHeight;
  });
}

// The number of samples around one whose cells are not the root's, which may get a link.
std::size_t linkable_around(const Tree& tree, Square sample) {
  const SampleGrid& grid = tree.grid();
  return static_cast<std::size_t>(std::count_if(std::begin(kJoined), std::end(kJoined), [&](Square by) {
    const int i = sample.i + by.i, j = sample.j + by.j;
    return i >= 0 && j >= 0 && i < grid.width && j < grid.depth &&
           tree.at_sample(i, j) >= tree.nodes()[0].cells();
  }));
}

class Linker {
 public:
  explicit Linker(Model& model)
      : tree_(model.tree), surface_(model.surface), links_(model.links), root_(tree_.nodes()[0].cells()) {}

  // Links both cells of each edge of a face between two heightmaps, where that link is nearer.
  void join(const Face& face) noexcept {
    for (std::size_t k = 0; k < 3; ++k) join(face[k], face[(k + 1) % 3]);
  }
  void join(CellId a, CellId b) noexcept {
    if (!across(a, b)) return;
    offer(a, b);
    offer(b, a);
  }
  bool across(CellId a, CellId b) const { return tree_.node_of(a) != tree_.node_of(b); }

  // Makes the link of a cell again from the surface around it.
  void search(CellId c) noexcept {
    links_.erase(c);
    if (c < root_) return;
    const glm::dvec2 p = tree_.plan(c);
    const auto look = [&](const Face& face) {
      if (std::find(face.begin(), face.end(), c) == face.end()) return;
      for (const CellId other : face) {
        if (across(c, other)) offer(c, other);
      }
    };
    surface_.range(p, p).each([&](Square s) {
      if (surface_.plain(tree_, s)) {
        for (const Face& face : ComposedSurface::plain_faces(ComposedSurface::corners(tree_, s))) look(face);
      }
      surface_.over(s, [&](FaceId f) { look(surface_.face(f)); });
    });
  }

  // Links the cells of an aligned heightmap with those beside them on plain squares.
  void join_plain(const GroundedHeightmap& node) noexcept {
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        if (at_rim(tree_, node, i, j)) join_plain(node, i, j);
      }
    }
  }

 private:
  void offer(CellId c, CellId target) noexcept {
    if (c < root_) return;
    const CellId now = links_.of(c);
    if (now == kNone || nearer(c, target, now)) links_.set(c, target);
  }
  bool nearer(CellId c, CellId a, CellId b) const {
    const glm::dvec3 at = tree_.position(c), to_a = glm::dvec3(tree_.position(a)) - at,
                     to_b = glm::dvec3(tree_.position(b)) - at;
    const double near = glm::dot(to_a, to_a), far = glm::dot(to_b, to_b);
    return near < far || (near == far && a < b);
  }

  bool plain(Square s) const {
    const SampleGrid& grid = tree_.grid();
    return s.i >= 0 && s.j >= 0 && s.i + 1 < grid.width && s.j + 1 < grid.depth && surface_.plain(tree_, s);
  }
  void join_plain(const GroundedHeightmap& node, int i, int j) noexcept {
    const CellId c = node.cell(i, j);
    const Square at{node.i0 + i, node.j0 + j};
    for (const Square by : kJoined) {
      // The squares on both sides of the edge; for a diagonal twice the one that it crosses.
      const Square first{at.i + std::min(by.i, 0), at.j + std::min(by.j, 0)};
      const Square second{first.i - (by.i == 0 ? 1 : 0), first.j - (by.j == 0 ? 1 : 0)};
      if (!plain(first) && !plain(second)) continue;
      const CellId other = tree_.at_sample(at.i + by.i, at.j + by.j);
      if (tree_.at_sample(at.i, at.j) != c || !across(c, other)) continue;
      offer(c, other);
      if (other < root_) continue;
      const CellId now = links_.of(other);
      if (now != kNone && tree_.kind(now) != CellKind::kHeight) {  // it was superseded
        search(other);
      } else {
        offer(other, c);
      }
    }
  }

  const Tree& tree_;
  const ComposedSurface& surface_;
  BoundaryLinks& links_;
  CellId root_;  // number of the root's cells
};

}  // namespace

std::size_t BoundaryLinks::slot_of(CellId c) const {
  std::size_t at = home(c);
  while (slots_[at].cell != kNone && slots_[at].cell != c) at = next(at);
  return at;
}

CellId BoundaryLinks::of(CellId c) const { return slots_.empty() ? kNone : slots_[slot_of(c)].target; }

void BoundaryLinks::prepare(std::size_t more) {
  const std::size_t least = (size_ + more) * 4 / 3 + 1;
  if (more == 0 || least <= slots_.size()) return;
  std::vector<Slot> old(std::max({kLeastSlots, least, slots_.size() * 3 / 2}));
  old.swap(slots_);
  for (const Slot& slot : old) {
    if (slot.cell != kNone) slots_[slot_of(slot.cell)] = slot;
  }
}

void BoundaryLinks::set(CellId c, CellId target) noexcept {
  Slot& slot = slots_[slot_of(c)];
  size_ += slot.cell == kNone;
  slot = {c, target};
}

void BoundaryLinks::erase(CellId c) noexcept {
  if (slots_.empty()) return;
  std::size_t hole = slot_of(c);
  if (slots_[hole].cell == kNone) return;
  --size_;
  // Later cells move back, so that no search stops at the hole before it reaches them.
  for (std::size_t at = next(hole); slots_[at].cell != kNone; at = next(at)) {
    if (steps(home(slots_[at].cell), at) < steps(hole, at)) continue;
    slots_[hole] = slots_[at];
    hole = at;
  }
  slots_[hole] = {};
}

RimChange rim_change(const Model& model, std::span<const Square> covered, std::span<const FaceId> removed,
                     std::span<const CellId> superseded, std::span<const Face> added, NodeId first_new) {
  const Tree& tree = model.tree;
  std::vector<CellId> corners = model.surface.cells_at(tree, covered, removed);
  RimChange change;
  std::set_difference(corners.begin(), corners.end(), superseded.begin(), superseded.end(),
                      std::back_inserter(change.rim));
  std::vector<CellId>& linked = corners;
  linked = change.rim;
  for (const Face& face : added) {
    for (std::size_t k = 0; k < 3; ++k) {
      const CellId a = face[k], b = face[(k + 1) % 3];
      if (tree.node_of(a) != tree.node_of(b)) linked.insert(linked.end(), {a, b});
    }
  }
  sort_unique(linked);
  change.most = linked.size();
  for (NodeId n = first_new; n < tree.nodes().size(); ++n) {
    const GroundedHeightmap& node = tree.nodes()[n];
    if (!node.aligned) continue;
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        if (at_rim(tree, node, i, j)) change.most += 1 + linkable_around(tree, {node.i0 + i, node.j0 + j});
      }
    }
  }
  return change;
}

void relink(Model& model, const RimChange& change, std::span<const CellId> superseded,
            std::span<const Face> added, NodeId first_new) noexcept {
  Linker linker(model);
  for (const CellId c : superseded) model.links.erase(c);
  for (const CellId c : change.rim) linker.search(c);
  for (const Face& face : added) linker.join(face);
  for (NodeId n = first_new; n < model.tree.nodes().size(); ++n) {
    if (model.tree.nodes()[n].aligned) linker.join_plain(model.tree.nodes()[n]);
  }
}

void link_all(Model& model) {
  const Tree& tree = model.tree;
  Linker linker(model);
  const auto join = [&](const Face& face) {
    model.links.prepare(2 * 3);
    linker.join(face);
  };
  const CellId root = tree.nodes()[0].cells();
  for (int j = 0; j + 1 < tree.grid().depth; ++j) {
    for (int i = 0; i + 1 < tree.grid().width; ++i) {
      if (!model.surface.plain(tree, {i, j})) continue;
      const auto corners = ComposedSurface::corners(tree, {i, j});
      if (std::all_of(corners.begin(), corners.end(), [&](CellId c) { return c < root; })) continue;
      for (const Face& face : ComposedSurface::plain_faces(corners)) join(face);
    }
  }
  model.surface.each_face([&](FaceId f) { join(model.surface.face(f)); });
}

}  // namespace terrabench::ght
