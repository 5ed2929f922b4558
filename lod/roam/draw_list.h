// The indices of the drawn triangles as one array without gaps. A triangle keeps its slot while it is drawn.
// New triangles take freed slots; at the end of a frame the last triangles fill those still free. So the
// bytes to upload are proportional to the changes. O(1) per change, plus a scan of one bit per triangle and
// frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/roam/node.h"
#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench::roam {

class DrawList {
 public:
  // `expected`: room for triangles at first; it grows when needed.
  explicit DrawList(std::size_t expected);
  void add(std::vector<Node>& nodes, std::uint32_t id, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void remove(std::vector<Node>& nodes, std::uint32_t id);
  // Fills the free slots and appends the index ranges that changed since the last call.
  void finish(std::vector<Node>& nodes, std::vector<DirtyRange>& uploads);

  std::span<const std::uint32_t> indices() const { return indices_; }
  std::size_t triangles() const { return owners_.size() - free_.size(); }
  std::uint32_t owner(std::size_t slot) const { return owners_[slot]; }
  Memory memory() const;

 private:
  void mark(std::uint32_t slot);

  std::vector<std::uint32_t> indices_;  // three per slot
  std::vector<std::uint32_t> owners_;   // node per slot; kNone when free
  std::vector<std::uint32_t> free_;
  std::vector<std::uint64_t> dirty_;  // one bit per slot
};

}  // namespace terrabench::roam
