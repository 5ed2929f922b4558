#include "lod/roam/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "lod/lod.h"
#include "terrain/error.h"

namespace terrabench::roam {

Mesh::Mesh(const GroundGrid& grid, std::size_t expected_leaves, Progress& progress)
    : grid_(grid), lattice_(lattice_over(grid.width, grid.depth)), wedgies_(lattice_, grid, progress) {
  add_roots();
  const std::size_t all = std::size_t{roots()} << lattice_.finest_level();
  add_pairs(std::max(std::min(expected_leaves, all), leaves_) - leaves_);
}

// The diagonals of neighbouring squares mirror each other, so that legs meet legs across every square's edge.
void Mesh::add_roots() {
  const int side = 1 << lattice_.side_log;
  nodes_.resize(roots());
  const auto square = [&](int a, int b) -> std::uint32_t {
    if (a < 0 || b < 0 || a >= lattice_.roots_x || b >= lattice_.roots_z) return kNone;
    return 2U * (static_cast<std::uint32_t>(b) * static_cast<std::uint32_t>(lattice_.roots_x) +
                 static_cast<std::uint32_t>(a));
  };
  // Root 0 of a square is its north-east half where the diagonal falls, its north-west half where it rises.
  const auto half = [](std::uint32_t first, std::uint32_t which) {
    return first == kNone ? kNone : first + which;
  };
  for (int b = 0; b < lattice_.roots_z; ++b) {
    for (int a = 0; a < lattice_.roots_x; ++a) {
      const std::uint32_t first = square(a, b);
      Node &north = nodes_[first], &south = nodes_[first + 1];
      const bool falling = (a + b) % 2 == 0;
      // A falling square has rising neighbours, and vice versa.
      const std::uint32_t of_north = half(square(a, b - 1), 1), of_south = half(square(a, b + 1), 0);
      const std::uint32_t of_west = half(square(a - 1, b), falling ? 1 : 0);
      const std::uint32_t of_east = half(square(a + 1, b), falling ? 0 : 1);
      north.u = falling ? (a + 1) * side : a * side;
      north.v = b * side;
      north.heading = falling ? 3 : 1;
      north.left = falling ? of_east : of_north;
      north.right = falling ? of_north : of_west;
      south.u = falling ? a * side : (a + 1) * side;
      south.v = (b + 1) * side;
      south.heading = falling ? 7 : 5;
      south.left = falling ? of_west : of_south;
      south.right = falling ? of_south : of_east;
      north.base = first + 1;
      south.base = first;
      set_thickness(north);
      set_thickness(south);
    }
  }
  leaves_ = nodes_.size();
}

void Mesh::set_thickness(Node& node) const {
  if (!splittable(node)) return;
  const Place m = middle(node);
  node.thickness = wedgies_.thickness(m.u, m.v);
}

void Mesh::edited(glm::ivec2 low, glm::ivec2 high) {
  const auto first = [](const std::vector<std::int32_t>& lines, int sample) {
    return static_cast<int>(std::lower_bound(lines.begin(), lines.end(), sample) - lines.begin());
  };
  wedgies_.update(lattice_, grid_, first(lattice_.column, low.x), first(lattice_.row, low.y),
                  first(lattice_.column, high.x + 1) - 1, first(lattice_.row, high.y + 1) - 1);
  for (Node& node : nodes_) {
    if (node.in_use) set_thickness(node);
  }
}

// Each new leaf takes one pair of nodes.
void Mesh::make_room(std::size_t leaves) {
  if (free_pairs() < leaves) add_pairs(std::max(nodes_.size() / 2, leaves - free_pairs()));
}

// The unused pairs form a list in ascending order.
void Mesh::add_pairs(std::size_t pairs) {
  const std::size_t first = nodes_.size();
  // Includes what Roam holds per node. While the pool grows, the old one exists as well.
  constexpr std::size_t kBytesPerNode = sizeof(Node) + 2 * sizeof(float);
  require_memory(
      2 * pairs * kBytesPerNode + (nodes_.capacity() < first + 2 * pairs ? first * kBytesPerNode : 0),
      "triangles of roam");
  if (first + 2 * pairs > kNone) {
    throw environment_error(fmt::format("{} triangles exceed 32-bit numbers", first + 2 * pairs), "roam",
                            "set a smaller limit on its triangles");
  }
  nodes_.resize(first + 2 * pairs);
  for (std::size_t pair = nodes_.size(); pair > first;) {
    pair -= 2;
    nodes_[pair].in_use = nodes_[pair + 1].in_use = false;
    nodes_[pair].parent = free_pair_;
    free_pair_ = static_cast<std::uint32_t>(pair);
  }
}

std::uint32_t Mesh::take_pair() {
  assert(free_pair_ != kNone);
  const std::uint32_t pair = free_pair_;
  free_pair_ = nodes_[pair].parent;
  if (free_pair_ != kNone) {
    __builtin_prefetch(&nodes_[free_pair_]);
    __builtin_prefetch(&nodes_[free_pair_ + 1]);
  }
  return pair;
}

// Bisects both halves, then links each half's children to the other's; bisect() links the rest.
void Mesh::bisect_diamond(std::uint32_t id) {
  assert(nodes_[id].leaf() && forms_diamond(id) && splittable(nodes_[id]));
  const std::uint32_t base = nodes_[id].base;
  make_room(base == kNone ? 1 : 2);
  bisect(id);
  if (base == kNone) return;
  bisect(base);
  // Across the common hypotenuse, the left child of one half borders on the right child of the other.
  const std::uint32_t here = nodes_[id].child, across = nodes_[base].child;  // the left children
  nodes_[here].right = across + 1;
  nodes_[here + 1].left = across;
  nodes_[across].right = here + 1;
  nodes_[across + 1].left = here;
}

//   left ---- m ---- right    pair:     apex m, its left corner the old apex, its right corner the old left
//       \     |     /         pair + 1: apex m, its left corner the old right, its right corner the old apex
//         \   |   /
//           apex
//
// The new apex is the middle of the hypotenuse. A leg becomes a child's hypotenuse, so the neighbour at the
// leg becomes the child's base neighbour; headings turn by 5 and 3 eighths of a turn.
void Mesh::bisect(std::uint32_t id) {
  const std::uint32_t pair = take_pair();
  Node& node = nodes_[id];
  const Place apex = middle(node);
  const auto make = [&](std::uint32_t child, unsigned turn, std::uint32_t base) {
    Node& half = nodes_[child] = {};
    half.u = apex.u;
    half.v = apex.v;
    half.level = static_cast<std::uint8_t>(node.level + 1);
    half.heading = static_cast<std::uint8_t>((node.heading + turn) % 8);
    half.parent = id;
    half.base = base;
    set_thickness(half);
  };
  make(pair, 5, node.left);
  make(pair + 1, 3, node.right);
  nodes_[pair].left = pair + 1;
  nodes_[pair + 1].right = pair;
  relink(node.left, id, pair);
  relink(node.right, id, pair + 1);
  node.child = pair;
  ++leaves_;
}

// Replaces the neighbour's link to `from` by one to `to`. Across a leg, the neighbour is of the same level
// (the edge is its leg: left or right) or one finer (the edge is its hypotenuse: base).
void Mesh::relink(std::uint32_t neighbour, std::uint32_t from, std::uint32_t to) {
  if (neighbour == kNone) return;
  Node& node = nodes_[neighbour];
  if (node.left == from) {
    node.left = to;
  } else if (node.right == from) {
    node.right = to;
  } else {
    assert(node.base == from);
    node.base = to;
  }
}

void Mesh::join_diamond(std::uint32_t id) {
  const std::uint32_t base = nodes_[id].base;
  join(id);
  if (base != kNone) join(base);
}

void Mesh::join(std::uint32_t id) {
  Node& node = nodes_[id];
  const std::uint32_t pair = node.child;
  assert(nodes_[pair].leaf() && nodes_[pair + 1].leaf());
  node.left = nodes_[pair].base;
  node.right = nodes_[pair + 1].base;
  relink(node.left, pair, id);
  relink(node.right, pair + 1, id);
  node.child = kNone;
  nodes_[pair].parent = free_pair_;
  nodes_[pair].in_use = nodes_[pair + 1].in_use = false;
  free_pair_ = pair;
  --leaves_;
}

void Mesh::prefetch_bisection(const Node& node) const {
  const Place m = middle(node);
  prefetch_corners(node);
  __builtin_prefetch(&grid_.heights[vertex(m)]);
  if (node.level + 1 >= lattice_.finest_level()) return;
  const int reach = middle_steps(lattice_.side_log, node.level + 1);
  for (const unsigned turn : {3U, 5U}) {
    const Step ahead = kSteps[(node.heading + turn) % 8];
    wedgies_.prefetch(m.u + ahead.u * reach, m.v + ahead.v * reach);
  }
}

// Each lattice line is rounded down to a line of samples, by less than a cell. So descendants extend beyond
// the triangle by less than a cell along either axis.
double Mesh::spill(const Node& node) const {
  if (lattice_.exact) return 0;
  const auto [apex, left, right] = places(node);
  const auto share = [](int a, int b, int c) {
    const int cells = std::max(a, std::max(b, c)) - std::min(a, std::min(b, c));
    return cells == 0 ? 1.0 : 1.0 / cells;
  };
  const std::vector<std::int32_t>&column = lattice_.column, &row = lattice_.row;
  return share(column[apex.u], column[left.u], column[right.u]) +
         share(row[apex.v], row[left.v], row[right.v]);
}

Memory Mesh::memory() const {
  Memory memory = wedgies_.memory();
  memory += lattice_.memory();
  memory += index_memory(nodes_);
  return memory;
}

}  // namespace terrabench::roam
