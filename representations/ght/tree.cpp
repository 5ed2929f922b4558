#include "representations/ght/tree.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "terrain/error.h"

namespace terrabench::ght {

Tree::Tree(const SampleGrid& grid, std::vector<float> heights) : grid_(grid) {
  GroundedHeightmap root;
  root.columns = grid.width;
  root.rows = grid.depth;
  root.plane.u.x = grid.spacing_x;
  root.plane.v.z = grid.spacing_z;
  root.aligned = true;
  append(root);
  for (CellId c = 0; c < cells(); ++c) {
    if (Heightfield::is_no_data(heights[c])) {
      has_holes_ = true;
    } else {
      set_height(c, heights[c]);
    }
  }
}

void Tree::resize_cells(std::size_t cells, NodeId node) {
  cells_.grow(cells);
  kinds_.grow((cells + kPerWord - 1) / kPerWord);
  pages_.grow((cells + kPage - 1) / kPage);
  cells_.resize(cells);
  kinds_.resize((cells + kPerWord - 1) / kPerWord);
  pages_.resize((cells + kPage - 1) / kPage, node);
}

NodeId Tree::append(GroundedHeightmap node) {
  const std::uint64_t before = cells(), cells = before + static_cast<std::uint64_t>(node.columns) *
                                                             static_cast<std::uint64_t>(node.rows);
  if (cells > most_cells_) {
    throw environment_error("has reached its largest number of cells", "grounded heightmap tree",
                            "apply fewer or smaller events, or raise most_cells");
  }
  node.first = static_cast<CellId>(before);
  node.depth = node.parent == kNone ? 0 : nodes_[node.parent].depth + 1;
  grow(nodes_, nodes_.size() + 1);
  resize_cells(static_cast<std::size_t>(cells), static_cast<NodeId>(nodes_.size()));
  nodes_.push_back(node);
  return static_cast<NodeId>(nodes_.size() - 1);
}

void Tree::truncate(std::size_t nodes) noexcept {
  if (nodes >= nodes_.size()) return;
  const CellId cells = nodes_[nodes].first;
  nodes_.resize(nodes);
  cells_.resize(cells);
  kinds_.resize((cells + kPerWord - 1) / kPerWord);
  pages_.resize((cells + kPage - 1) / kPage);
  // The last word may hold kinds of removed cells.
  if (cells % kPerWord != 0) kinds_.back() &= (1U << cells % kPerWord * 2) - 1;
}

Memory Tree::memory() const {
  Memory memory = cells_.payload();
  memory += kinds_.payload();
  memory += pages_.index();
  memory += index_memory(nodes_, events_);
  return memory;
}

}  // namespace terrabench::ght
