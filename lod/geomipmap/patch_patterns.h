// The index patterns of geomipmapping, one per shape of patch, level and set of seams, shared by all patches
// (de Boer 2000, §2.1 and §2.4).
//
// At level l a patch keeps every 2^l-th sample along each axis, and always the last one. Each cell has two
// triangles, either all split in one direction or all split through a vertex with odd coordinates. In the
// second case, once an odd vertex of a side has morphed to the middle of its neighbours, dropping it does not
// change the surface. A side whose neighbour is one level coarser (a seam) has its odd vertices moved onto
// the even ones beside them, which leaves the neighbour's own edge. Each odd vertex belongs to one side, so
// seams at several sides are independent, unless the patch is a single cell deep.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench {

class PatchPatterns {
 public:
  enum class Split : bool { kOneWay, kThroughOdd };
  // For the shapes that occur in the grid and levels 0 … `levels` - 1. O(side²) indices.
  PatchPatterns(const PatchGrid&, int levels, Split split = Split::kOneWay);

  // `seams`: bit s is set when the neighbour at side s is coarser; 0 at the last level.
  const IndexRange& pattern(int shape, int level, int seams) const {
    return patterns_[static_cast<std::size_t>((shape * levels_ + level) * 16 + seams)];
  }
  // Vertices of the field, relative to the patch's low corner.
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const std::uint32_t> indices(const IndexRange& range) const {
    return std::span(indices_).subspan(range.first_index, range.index_count);
  }
  Memory memory() const;

 private:
  IndexRange add(const PatchGrid::Patch&, int stride, int level, int seams);

  int levels_;
  Split split_;
  std::vector<IndexRange> patterns_;  // by shape, level and seams
  std::vector<std::uint32_t> indices_;
};

}  // namespace terrabench
