// The index patterns of CDLOD: per level one for whole nodes and one for each way in which the ground's
// border cuts a node, its four quarters one after another, so that a batch draws any consecutive ones.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/cdlod/node_tree.h"
#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench::cdlod {

class NodePatterns {
 public:
  // `side`: of the nodes, cells. O(side² · levels) indices.
  NodePatterns(const NodeTree&, int side);

  // The triangles of quarters `first` to `last` - 1 of a node: 0 north-west, 1 north-east, 2 south-west, 3
  // south-east. `shape`: PatchGrid::shape().
  IndexRange quarters(int level, int shape, int first, int last) const {
    const Ends& ends = ends_[static_cast<std::size_t>(4 * level + shape)];
    const std::uint32_t begin = ends[static_cast<std::size_t>(first)];
    return {begin, ends[static_cast<std::size_t>(last)] - begin};
  }
  // Vertices of the ground, relative to the node's low corner.
  std::span<const std::uint32_t> indices() const { return indices_; }
  Memory memory() const;

 private:
  using Ends = std::array<std::uint32_t, 5>;  // of the quarters, from the first one's begin on

  Ends add(const PatchGrid::Patch&, int width, int side, int step);

  std::vector<Ends> ends_;  // by level and shape
  std::vector<std::uint32_t> indices_;
};

}  // namespace terrabench::cdlod
