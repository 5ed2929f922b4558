#include "representations/ght/model.h"

#include <cmath>
#include <glm/common.hpp>

namespace terrabench::ght {

NodeIndex::NodeIndex(const SampleGrid& grid)
    : tiles_x_((static_cast<std::size_t>(std::max(grid.width - 1, 1)) + kSide - 1) / kSide) {
  first_.assign(tiles_x_ * ((static_cast<std::size_t>(std::max(grid.depth - 1, 1)) + kSide - 1) / kSide),
                kNone);
}

void NodeIndex::add(const SquareRange& range, NodeId node) noexcept {
  range.tiles(kSide).each([&](Square at) {
    std::uint32_t& first = first_[tile({at.i * kSide, at.j * kSide})];
    entries_.push_back({node, first});
    first = static_cast<std::uint32_t>(entries_.size() - 1);
  });
}

Memory NodeIndex::memory() const {
  Memory memory = index_memory(first_, entries_);
  return memory;
}

Model::Model(Tree t, float lowest, float highest)
    : tree(std::move(t)), surface(tree.grid()), index(tree.grid()), floor(lowest), ceiling(highest) {}

void Model::index_node(NodeId n) {
  const SquareRange r = range(tree.nodes()[n]);
  index.prepare(NodeIndex::tiles(r));
  index.add(r, n);
}

SquareRange Model::range(const GroundedHeightmap& map) const {
  const SampleGrid& grid = tree.grid();
  PlanBounds box;
  for (const int j : {0, map.rows - 1}) {
    for (const int i : {0, map.columns - 1}) {
      const glm::dvec3 p =
          map.aligned ? glm::dvec3(grid.x(map.i0 + i), 0, grid.z(map.j0 + j)) : map.plane.at(i, j, 0);
      box.add({p.x, p.z});
    }
  }
  return surface.range(box.low, box.high);
}

}  // namespace terrabench::ght
