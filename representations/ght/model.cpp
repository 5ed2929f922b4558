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
  Memory memory = index_memory(first_);
  memory += index_memory(entries_);
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
  glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
  for (const int j : {0, map.rows - 1}) {
    for (const int i : {0, map.columns - 1}) {
      const glm::dvec3 p =
          map.aligned ? glm::dvec3(grid.x(map.i0 + i), 0, grid.z(map.j0 + j)) : map.plane.at(i, j, 0);
      low = glm::min(low, glm::dvec2(p.x, p.z));
      high = glm::max(high, glm::dvec2(p.x, p.z));
    }
  }
  return surface.range(low, high);
}

}  // namespace terrabench::ght
