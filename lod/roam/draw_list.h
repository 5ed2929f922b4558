// The drawn triangles as one run of indices without gaps, in which a triangle keeps its place as long as it
// is drawn. Freed places go to the next triangles, and what is left of them at the end of a frame to the last
// ones: the bytes to upload follow the changes. O(1) a change, plus a bit a triangle for each frame.
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
  // There is room for so many triangles from the start, and for more when they come.
  explicit DrawList(std::size_t expected);
  void add(std::vector<Node>& nodes, std::uint32_t id, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void remove(std::vector<Node>& nodes, std::uint32_t id);
  // Closes the gaps and appends what changed since the last call.
  void finish(std::vector<Node>& nodes, std::vector<DirtyRange>& uploads);

  std::span<const std::uint32_t> indices() const { return indices_; }
  std::size_t triangles() const { return owners_.size() - free_.size(); }
  std::uint32_t owner(std::size_t slot) const { return owners_[slot]; }
  Memory memory() const;

 private:
  void mark(std::uint32_t slot);

  std::vector<std::uint32_t> indices_;  // three a slot
  std::vector<std::uint32_t> owners_;   // node of a slot; kNone when free
  std::vector<std::uint32_t> free_;
  std::vector<std::uint64_t> dirty_;  // a bit a slot
};

}  // namespace terrabench::roam
