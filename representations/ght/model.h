// All that events change: the tree, the surface composed of its heightmaps, the links between their boundary
// cells, and an index of the heightmaps by place.
#pragma once

#include <vector>

#include "representations/ght/boundary_links.h"
#include "representations/ght/composed_surface.h"
#include "representations/ght/tree.h"

namespace terrabench::ght {

// Nodes by their place in plan, for finding an event's host. Each tile lists the nodes that touch it.
class NodeIndex {
 public:
  NodeIndex() = default;
  explicit NodeIndex(const SampleGrid& grid);

  // Calls visit(NodeId) for the nodes over the tile of a square, the latest first.
  template <class Visit>
  void over(Square s, const Visit& visit) const {
    for (std::uint32_t e = first_[tile(s)]; e != kNone; e = entries_[e].next) visit(entries_[e].node);
  }
  static std::size_t tiles(const SquareRange& range) { return range.tiles(kSide).count(); }
  void prepare(std::size_t tiles) { grow(entries_, entries_.size() + tiles); }  // allocates; may throw
  void add(const SquareRange& range, NodeId node) noexcept;
  Memory memory() const;

 private:
  static constexpr int kSide = 32;  // squares along a tile
  struct Entry {
    NodeId node;
    std::uint32_t next;
  };
  std::size_t tile(Square s) const {
    return static_cast<std::size_t>(s.j / kSide) * tiles_x_ + static_cast<std::size_t>(s.i / kSide);
  }
  std::size_t tiles_x_ = 0;
  std::vector<std::uint32_t> first_;
  std::vector<Entry> entries_;
};

struct Model {
  Tree tree;
  ComposedSurface surface;
  BoundaryLinks links;
  NodeIndex index;               // of outdoor nodes except the root
  float floor = 0, ceiling = 0;  // below and above all ground, metres
  bool carved = false;           // whether there are tunnels or caves

  Model() = default;
  Model(Tree tree, float floor, float ceiling);
  void index_node(NodeId node);  // for loading; Edit::commit() indexes its own nodes
  // The squares below a heightmap's plane.
  SquareRange range(const GroundedHeightmap& heightmap) const;
};

inline bool is_carving(events::Kind kind) {
  return kind == events::Kind::kTunnel || kind == events::Kind::kCave;
}

}  // namespace terrabench::ght
