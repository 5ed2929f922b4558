// The triangles of the binary triangle trees (Duchaineau et al. 1997, §§4-5): their topology and geometry,
// without queues. Triangles are bisected and joined by diamonds, two triangles that share a hypotenuse (one
// triangle at the border), so the mesh of leaves always conforms. Nodes live in one pool, children in pairs;
// unused pairs are recycled. Bisecting and joining are O(1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/roam/lattice.h"
#include "lod/roam/node.h"
#include "lod/roam/wedgie_view.h"
#include "lod/roam/wedgies.h"
#include "terrain/frame.h"

namespace terrabench::roam {

class Mesh {
 public:
  // `expected_leaves`: room in the pool at first; it grows when more are made.
  Mesh(const GroundGrid&, std::size_t expected_leaves, Progress&);

  // The heights at samples low … high have changed: bounds their triangles again. O(nodes + samples)
  void edited(glm::ivec2 low, glm::ivec2 high);

  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::uint32_t roots() const { return 2U * static_cast<std::uint32_t>(lattice_.roots_x * lattice_.roots_z); }
  std::size_t leaves() const { return leaves_; }
  // Leaves that the pool has room for.
  std::size_t capacity() const { return leaves_ + free_pairs(); }
  const Lattice& lattice() const { return lattice_; }
  const GroundGrid& grid() const { return grid_; }

  bool splittable(const Node& node) const { return node.level < lattice_.finest_level(); }
  // Whether the triangle and its base neighbour, if any, form a diamond: they can be bisected together. If
  // not, the base neighbour is one level coarser.
  bool forms_diamond(std::uint32_t id) const {
    const std::uint32_t base = nodes_[id].base;
    return base == kNone || nodes_[base].base == id;
  }
  // A triangle whose corners are collinear in plan, because two lattice lines lie over one line of samples:
  // its apex lies on its hypotenuse. It must always be split; as a leaf, its apex would be a T-junction.
  bool degenerate(const Node& node) const {
    if (lattice_.exact || node.level != lattice_.finest_level() - 1) return false;
    const Step ahead = kSteps[node.heading];
    return ahead.u != 0 ? lattice_.column[node.u] == lattice_.column[node.u + ahead.u]
                        : lattice_.row[node.v] == lattice_.row[node.v + ahead.v];
  }
  // Whether two corners are the same sample, so that there is nothing to draw.
  static bool empty(const std::array<std::uint32_t, 3>& vertices) {
    return vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[0] == vertices[2];
  }

  // Allocates nodes for this many more leaves. Throws environment_error, with the mesh unchanged, when there
  // is not enough memory.
  void make_room(std::size_t leaves);
  // Bisects the leaf and its base neighbour. forms_diamond() must hold.
  void bisect_diamond(std::uint32_t id);
  // Undoes bisect_diamond(); all children must be leaves.
  void join_diamond(std::uint32_t id);

  // Grid vertices, counter-clockwise from above.
  std::array<std::uint32_t, 3> vertices(const Node& node) const {
    const auto [apex, left, right] = places(node);
    return {vertex(apex), vertex(right), vertex(left)};
  }
  Corners corners(const Node& node) const {
    const auto [apex, left, right] = places(node);
    return {{corner(apex), corner(left), corner(right)}};
  }
  glm::dvec3 apex(const Node& node) const { return corner({node.u, node.v}); }
  // Prefetches what bisecting the triangle reads, except nodes.
  void prefetch_bisection(const Node&) const;
  // Prefetches the heights of its corners.
  void prefetch_corners(const Node& node) const {
    for (const Place p : places(node)) __builtin_prefetch(&grid_.heights[vertex(p)]);
  }
  // Prefetches a node; nothing for kNone.
  void prefetch(std::uint32_t id) const {
    if (id != kNone) __builtin_prefetch(&nodes_[id]);
  }
  // The share of the triangle's size by which its descendants may extend beyond it in plan: 0 unless lattice
  // lines share samples.
  double spill(const Node&) const;

  Memory memory() const;

 private:
  struct Place {
    std::int32_t u, v;
  };
  // Apex, left, right.
  std::array<Place, 3> places(const Node& node) const {
    const int legs = leg_steps(lattice_.side_log, node.level);
    const Step left = kSteps[(node.heading + 7U) % 8], right = kSteps[(node.heading + 1U) % 8];
    return {{{node.u, node.v},
             {node.u + left.u * legs, node.v + left.v * legs},
             {node.u + right.u * legs, node.v + right.v * legs}}};
  }
  // The middle of the hypotenuse.
  Place middle(const Node& node) const {
    const int reach = middle_steps(lattice_.side_log, node.level);
    return {node.u + kSteps[node.heading].u * reach, node.v + kSteps[node.heading].v * reach};
  }
  glm::dvec3 corner(Place p) const {
    const int i = lattice_.column[p.u], j = lattice_.row[p.v];
    return {static_cast<float>(i) * grid_.cell_x,
            grid_.heights[static_cast<std::size_t>(j) * grid_.width + i],
            static_cast<float>(j) * grid_.cell_z};
  }
  std::uint32_t vertex(Place p) const {
    return static_cast<std::uint32_t>(lattice_.row[p.v]) * static_cast<std::uint32_t>(grid_.width) +
           static_cast<std::uint32_t>(lattice_.column[p.u]);
  }
  void add_roots();
  std::size_t free_pairs() const { return (nodes_.size() - roots()) / 2 - (leaves_ - roots()); }
  void add_pairs(std::size_t pairs);
  std::uint32_t take_pair();
  void bisect(std::uint32_t id);
  void join(std::uint32_t id);
  void set_thickness(Node&) const;
  void relink(std::uint32_t neighbour, std::uint32_t from, std::uint32_t to);

  GroundGrid grid_;
  Lattice lattice_;
  Wedgies wedgies_;
  std::vector<Node> nodes_;
  std::uint32_t free_pair_ = kNone;
  std::size_t leaves_ = 0;
};

}  // namespace terrabench::roam
