#include "representations/ght/invariants.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace terrabench::ght {
namespace {

class Inspector {
 public:
  explicit Inspector(const Model& model) : model_(model), tree_(model.tree), surface_(model.surface) {}

  std::vector<std::string> run() {
    nodes();
    counts();
    faces();
    links();
    list_edges();
    edges();
    expect(unlinked_boundary_cells(model_),
           "boundary cells of a new heightmap without a link to another one");
    expect(check_boundary_links(model_).wrong, "boundary links other than the surface's triangles have");
    return std::move(problems_);
  }

 private:
  void expect(std::size_t wrong, std::string_view what) {
    if (wrong > 0) problems_.push_back(fmt::format("{}: {}", what, wrong));
  }

  void nodes() {
    std::size_t wrong = 0;
    for (NodeId n = 1; n < tree_.nodes().size(); ++n) {
      const GroundedHeightmap& node = tree_.nodes()[n];
      wrong += node.parent >= n || node.depth != tree_.nodes()[node.parent].depth + 1;
    }
    expect(wrong, "nodes whose parent is not an earlier one");
  }

  std::size_t borders(const Applied& event) const {
    std::size_t n = 0;
    for (NodeId k = event.first; k < event.first + event.nodes; ++k) {
      n += tree_.nodes()[k].area == Area::kBorder;
    }
    return n;
  }

  // Whether the event added as many heightmaps as in the paper; a section has at least three sides.
  bool has_papers_count(const Applied& event) const {
    constexpr std::array<std::uint32_t, 5> kGeotectonic = {4, 1, 3, 3, 2};  // in the order of events::Kind
    if (!is_carving(event.kind)) return event.nodes == kGeotectonic[static_cast<std::size_t>(event.kind)];
    return borders(event) == (event.kind == events::Kind::kTunnel ? 2U : 1U) && event.nodes >= 2 + 3;
  }

  void counts() {
    std::size_t wrong = 0, of_events = 0;
    for (const Applied& event : tree_.events()) {
      of_events += event.nodes;
      wrong += !has_papers_count(event);
    }
    expect(wrong, "events that did not add the paper's number of heightmaps");
    expect(of_events + 1 != tree_.nodes().size() ? 1 : 0, "heightmaps that no event added");
  }

  // Whether any of the squares around a sample is plain.
  bool plain_around(int i, int j) const {
    const SampleGrid& grid = tree_.grid();
    for (int k = 0; k < 4; ++k) {
      const Square s{i - k % 2, j - k / 2};
      if (s.i >= 0 && s.j >= 0 && s.i + 1 < grid.width && s.j + 1 < grid.depth && surface_.plain(tree_, s)) {
        return true;
      }
    }
    return false;
  }

  void faces() {
    std::size_t elsewhere = 0, unindexed = 0;
    const SampleGrid& grid = tree_.grid();
    for (int j = 0; j < grid.depth; ++j) {
      for (int i = 0; i < grid.width; ++i) {
        if (!plain_around(i, j)) continue;
        const glm::vec2 at = tree_.plan(tree_.at_sample(i, j));
        elsewhere += at != glm::vec2(grid.x(i), grid.z(j));
      }
    }
    surface_.each_face([&](FaceId f) {
      surface_.range(tree_, surface_.face(f)).each([&](Square s) {
        bool found = false;
        surface_.over(s, [&](FaceId other) { found = found || other == f; });
        unindexed += !found;
      });
    });
    expect(elsewhere, "corners of plain squares that are elsewhere");
    expect(unindexed, "faces that are not in the index of a square");
  }

  void links() {
    std::size_t backwards = 0;
    for (CellId c = 0; c < tree_.cells(); ++c) {
      backwards += tree_.kind(c) == CellKind::kLink && tree_.target(c) <= c;
    }
    expect(backwards, "links that do not lead to later cells");
    const Breaks breaks = count_breaks(model_);
    expect(breaks.voids_seen, "corners of the surface without a height");
    expect(breaks.dangling, "links that do not lead to the surface");
  }

  // The ends of the edges from cell c are ends_[first_[c]] … ends_[first_[c + 1] - 1], ascending.
  void list_edges() {
    first_.assign(tree_.cells() + std::size_t{1}, 0);
    surface_.each_triangle(tree_, [&](const Face& face) {
      for (const CellId c : face) ++first_[c];
    });
    std::size_t sum = 0;
    for (std::size_t& first : first_) sum += std::exchange(first, sum);
    ends_.resize(sum);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    surface_.each_triangle(tree_, [&](const Face& face) {
      for (std::size_t k = 0; k < 3; ++k) ends_[next[face[k]]++] = face[(k + 1) % 3];
    });
    for (CellId c = 0; c < tree_.cells(); ++c) {
      std::sort(ends_.begin() + static_cast<std::ptrdiff_t>(first_[c]),
                ends_.begin() + static_cast<std::ptrdiff_t>(first_[c + 1]));
    }
  }
  std::span<const CellId> edges_from(CellId c) const {
    return std::span(ends_).subspan(first_[c], first_[c + 1] - first_[c]);
  }

  void edges() {
    std::size_t twice = 0, open = 0;
    for (CellId c = 0; c < tree_.cells(); ++c) {
      const std::span<const CellId> ends = edges_from(c);
      for (std::size_t k = 0; k < ends.size(); ++k) {
        twice += k > 0 && ends[k] == ends[k - 1];
        const std::span<const CellId> back = edges_from(ends[k]);
        if (!std::binary_search(back.begin(), back.end(), c)) open += !at_rim(c, ends[k]);
      }
    }
    expect(twice, "edges that two faces have in the same direction");
    expect(open, "edges with one face only");
  }
  // Whether an edge lies at the terrain's border or at a hole.
  bool at_rim(CellId from, CellId to) const {
    const SampleGrid& grid = tree_.grid();
    const glm::vec2 a = tree_.plan(from), b = tree_.plan(to);
    const SquareRange r =
        surface_.range({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)});
    if (a.x == b.x && (a.x == grid.x(0) || a.x == grid.x(grid.width - 1))) return true;
    if (a.y == b.y && (a.y == grid.z(0) || a.y == grid.z(grid.depth - 1))) return true;
    bool at_hole = false;
    r.each([&](Square s) { at_hole = at_hole || ComposedSurface::hole(tree_, s); });
    return at_hole;
  }

  const Model& model_;
  const Tree& tree_;
  const ComposedSurface& surface_;
  std::vector<std::size_t> first_;
  std::vector<CellId> ends_;
  std::vector<std::string> problems_;
};

}  // namespace

Census census(const Model& model) {
  const Tree& tree = model.tree;
  Census all;
  all.nodes = tree.nodes().size();
  all.faces = model.surface.faces();
  for (const GroundedHeightmap& node : tree.nodes()) all.deepest = std::max(all.deepest, node.depth);
  for (CellId c = 0; c < tree.cells(); ++c) {
    const CellKind kind = tree.kind(c);
    ++(kind == CellKind::kHeight ? all.heights : kind == CellKind::kLink ? all.links : all.voids);
  }
  all.boundary_links = model.links.size();
  return all;
}

LinkReport check_boundary_links(const Model& model) {
  const Tree& tree = model.tree;
  const auto distance = [&](CellId a, CellId b) {
    const glm::dvec3 along = glm::dvec3(tree.position(b)) - glm::dvec3(tree.position(a));
    return glm::dot(along, along);
  };
  std::vector<CellId> nearest(tree.cells(), kNone);
  model.surface.each_triangle(tree, [&](const Face& face) {
    for (const CellId c : face) {
      if (c < tree.nodes()[0].cells()) continue;
      for (const CellId other : face) {
        if (tree.node_of(other) == tree.node_of(c)) continue;
        CellId& best = nearest[c];
        if (best == kNone || std::pair(distance(c, other), other) < std::pair(distance(c, best), best)) {
          best = other;
        }
      }
    }
  });
  LinkReport report;
  report.stored = model.links.size();
  std::size_t found = 0;
  for (CellId c = 0; c < tree.cells(); ++c) {
    const CellId stored = model.links.of(c);
    report.derived += nearest[c] != kNone;
    report.wrong += nearest[c] != stored;
    found += stored != kNone;
  }
  report.wrong += report.stored - found;  // links of cells that the tree does not have
  return report;
}

std::size_t unlinked_boundary_cells(const Model& model) {
  const Tree& tree = model.tree;
  if (tree.events().empty()) return 0;
  std::vector<char> seen(tree.cells(), 0);
  model.surface.each_triangle(tree, [&](const Face& face) {
    for (const CellId c : face) seen[c] = 1;
  });
  std::size_t unlinked = 0;
  const Applied& last = tree.events().back();
  for (NodeId n = last.first; n < last.first + last.nodes; ++n) {
    const GroundedHeightmap& node = tree.nodes()[n];
    const auto beyond = [&](int i, int j) {  // the heightmap
      return i < 0 || j < 0 || i >= node.columns || j >= node.rows ||
             tree.kind(node.cell(i, j)) == CellKind::kVoid;
    };
    for (int j = 0; j < node.rows; ++j) {
      for (int i = 0; i < node.columns; ++i) {
        const CellId c = node.cell(i, j);
        if (seen[c] == 0 || model.links.of(c) != kNone) continue;
        unlinked += beyond(i - 1, j) || beyond(i + 1, j) || beyond(i, j - 1) || beyond(i, j + 1);
      }
    }
  }
  return unlinked;
}

Breaks count_breaks(const Model& model) {
  const Tree& tree = model.tree;
  Breaks found;
  std::vector<char> seen(tree.cells(), 0);
  model.surface.each_triangle(tree, [&](const Face& face) {
    for (const CellId c : face) {
      seen[c] = 1;
      found.voids_seen += tree.kind(c) != CellKind::kHeight;
    }
  });
  for (CellId c = 0; c < tree.cells(); ++c) {
    if (tree.kind(c) != CellKind::kLink || tree.target(c) <= c) continue;
    const CellId end = tree.resolve(c);
    const bool null =
        tree.kind(end) == CellKind::kVoid && tree.nodes()[tree.node_of(end)].area == Area::kBorder;
    found.dangling += !null && seen[end] == 0;
  }
  return found;
}

std::vector<std::string> broken_invariants(const Model& model) { return Inspector(model).run(); }

}  // namespace terrabench::ght
