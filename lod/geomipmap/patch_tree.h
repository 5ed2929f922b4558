// The quadtree over the patches, for culling (de Boer 2000, §2.2): a pyramid of flat arrays with the lowest
// and highest ground of each quad. Patches are numbered so that those of any quad are consecutive: the
// patches in view are a few ranges of numbers, and arrays by number are read in order. O(patches) to build;
// collect() is O(quads that cross the frustum's border).
#pragma once

#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "lod/screen_bound.h"
#include "terrain/frame.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"
#include "terrain/solid.h"

namespace terrabench {

class PatchTree {
 public:
  PatchTree(const GroundGrid&, const PatchGrid&);

  struct Place {
    std::uint32_t slot;    // PatchGrid::slot()
    std::uint32_t corner;  // vertex at the low corner
    std::int32_t shape;    // PatchGrid::shape()
  };
  std::span<const Place> places() const { return places_; }  // by number
  std::size_t number(int at_x, int at_z) const {
    return quads_[static_cast<std::size_t>(at_z) * cut_.across() + at_x].patches.first;
  }
  const Boxes& boxes() const { return boxes_; }  // by number

  struct PatchRange {
    std::uint32_t first, last;  // numbers; `last` is one past the end
  };
  // Appends the patches that the frustum may see, in ascending order.
  void collect(const Frustum&, std::vector<PatchRange>& seen) const;
  // Upper bound of the ranges that collect() appends.
  std::size_t most_ranges() const { return (places_.size() + 1) / 2; }
  // Measures the heights of these patches again.
  void measure(const GroundGrid&, const PatchGrid::PatchRect&);
  Memory memory() const;

 private:
  struct Quad {
    float lowest, highest;  // metres
    PatchRange patches;
  };
  struct Layer {  // of the pyramid
    int across, down;
    std::size_t first;  // quad
  };
  Quad& quad(int layer, int at_x, int at_z);
  void number(int layer, int at_x, int at_z);
  void measure_patch(const GroundGrid&, int at_x, int at_z);
  Bounds box(int layer, int at_x, int at_z) const;
  void collect(int layer, int at_x, int at_z, unsigned planes, const Frustum&,
               std::vector<PatchRange>&) const;

  PatchGrid cut_;
  float cell_x_, cell_z_;
  std::vector<Layer> layers_;  // patches first, the root last
  std::vector<Quad> quads_;
  std::vector<Place> places_;
  Boxes boxes_;
};

// Calls use(number) for every patch in the ranges, in order.
template <class Use>
void for_each_patch(std::span<const PatchTree::PatchRange> ranges, const Use& use) {
  for (const PatchTree::PatchRange& range : ranges) {
    for (std::uint32_t k = range.first; k < range.last; ++k) use(k);
  }
}

}  // namespace terrabench
