// The index patterns of geomipmapping: one for each shape of patch, level and seam case, shared by all
// patches (de Boer 2000, §2.1 and 2.4).
//
// At level l a patch keeps every 2^l-th sample each way and, whatever its size, its last; two triangles a
// cell, split from low x, high z, or all through the vertices of odd place: then an odd vertex of a side
// has but one vertex across, so that once it stands between its neighbours it can go without a change of the
// surface. A side whose neighbour is one level coarser has its odd vertices pulled
// onto the even ones beside them, which leaves the neighbour's own edge. Each odd vertex belongs to one side
// alone, so the 16 combinations of sides are the four single ones laid together, unless the patch is but one
// cell deep.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "terrain/memory.h"

namespace terrabench {

class PatchPatterns {
 public:
  struct Run {
    std::uint32_t first = 0, count = 0;
  };

  enum class Split : bool { kOneWay, kThroughOdd };
  // For the shapes that occur in the grid, levels 0 … `levels` - 1. O(side²) indices.
  PatchPatterns(const PatchGrid&, int levels, Split split = Split::kOneWay);

  // seams: bit s is set for a coarser neighbour at side s. At the last level there is none.
  const Run& run(int shape, int level, int seams) const {
    return runs_[static_cast<std::size_t>((shape * levels_ + level) * 16 + seams)];
  }
  // Vertices of the whole field, from the patch's low corner on.
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const std::uint32_t> indices(const Run& run) const {
    return std::span(indices_).subspan(run.first, run.count);
  }
  Memory memory() const;

 private:
  Run add(const PatchGrid::Patch&, int stride, int level, int seams);

  int levels_;
  Split split_;
  std::vector<Run> runs_;  // by shape, level and seams
  std::vector<std::uint32_t> indices_;
};

}  // namespace terrabench
