// The bintrees as a mesh that always conforms (Duchaineau et al. 1997, §§4-5): triangles are split and merged
// by diamonds, the pairs that share a hypotenuse. Nodes live in one pool, children in pairs; freed pairs are
// used again. Splits and merges are O(1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/roam/camera.h"
#include "lod/roam/lattice.h"
#include "lod/roam/node.h"
#include "lod/roam/wedgies.h"
#include "terrain/frame.h"

namespace terrabench::roam {

class Mesh {
 public:
  // The pool has room for so many leaves from the start, and grows when more are asked for.
  Mesh(const GroundGrid&, std::size_t expected_leaves, Progress&);

  std::vector<Node>& nodes() { return nodes_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  std::uint32_t roots() const { return 2U * static_cast<std::uint32_t>(lattice_.roots_x * lattice_.roots_z); }
  std::size_t leaves() const { return leaves_; }
  // As many as the pool has room for.
  std::size_t room() const { return leaves_ + free_pairs(); }
  const Lattice& lattice() const { return lattice_; }
  const GroundGrid& grid() const { return grid_; }

  bool splittable(const Node& node) const { return node.level < lattice_.finest_level(); }
  // The triangle's hypotenuse has nothing coarser behind it: it and its base neighbour can split.
  bool conforms_split(std::uint32_t id) const {
    const std::uint32_t base = nodes_[id].base;
    return base == kNone || nodes_[base].base == id;
  }
  // A triangle between two lattice lines over one line of samples, standing on edge: its apex lies on its
  // hypotenuse as the map shows it. It must be split as long as it exists, or that corner would be a
  // T-junction.
  bool on_edge(const Node& node) const {
    if (lattice_.exact || node.level != lattice_.finest_level() - 1) return false;
    const Step ahead = kSteps[node.heading];
    return ahead.u != 0 ? lattice_.column[node.u] == lattice_.column[node.u + ahead.u]
                        : lattice_.row[node.v] == lattice_.row[node.v + ahead.v];
  }
  // Two corners are one sample: nothing to draw.
  static bool empty(const std::array<std::uint32_t, 3>& vertices) {
    return vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[0] == vertices[2];
  }

  // Lets so many more leaves be made without more memory. Throws environment_error, and leaves the mesh as it
  // is, when that cannot be had.
  void make_room(std::size_t leaves);
  // Splits the leaf, and the base neighbour with it. conforms_split() must hold.
  void split(std::uint32_t id);
  // Undoes that; all children must be leaves.
  void merge(std::uint32_t id);

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
  // Has the memory fetched that splitting the triangle will read, but for other nodes.
  void prefetch_split(const Node&) const;
  // The heights of its corners.
  void prefetch_corners(const Node& node) const {
    for (const Place p : places(node)) __builtin_prefetch(&grid_.heights[vertex(p)]);
  }
  // A node, if it is one.
  void prefetch(std::uint32_t id) const {
    if (id != kNone) __builtin_prefetch(&nodes_[id]);
  }
  // The share of its size by which descendants may stick out of a triangle, where lattice lines share
  // samples.
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
  // Of the hypotenuse.
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
  void bound(Node&) const;
  void relink(std::uint32_t neighbour, std::uint32_t from, std::uint32_t to);

  GroundGrid grid_;
  Lattice lattice_;
  Wedgies wedgies_;
  std::vector<Node> nodes_;
  std::uint32_t free_pair_ = kNone;
  std::size_t leaves_ = 0;
};

}  // namespace terrabench::roam
