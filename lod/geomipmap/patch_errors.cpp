#include "lod/geomipmap/patch_errors.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lod/plan_triangle.h"

namespace terrabench {
namespace {

// Measures one patch.
class Ruler {
 public:
  Ruler(const GroundGrid& grid, const PatchGrid& cut, const PatchPatterns& patterns,
        const PatchGrid::Patch& patch)
      : grid_(grid), patterns_(patterns), patch_(patch), shape_(cut.shape(patch)) {}

  float whole(int level) const {
    return largest(level, 0, [](const Corner&) { return true; });
  }

  // Of the outermost ring of cells at a side, the last of which may be narrower than the others.
  float seam(int level, Side side) const {
    const int step = 1 << level;
    const bool across = side == kEast || side == kWest;
    const int cells = across ? patch_.columns : patch_.rows, low = across ? patch_.i0 : patch_.j0;
    if (cells <= step) {  // both sides pull at the same triangles
      const int alone = 1 << side, both = alone | 1 << (side ^ 2);
      return std::max(largest(level, alone, [](const Corner&) { return true; }),
                      largest(level, both, [](const Corner&) { return true; }));
    }
    const int last = low + (cells - 1) / step * step;
    return largest(level, 1 << side, [&](const Corner& c) {
      const int at = across ? c.x : c.z;
      return side == kNorth || side == kWest ? at <= low + step : at >= last;
    });
  }

 private:
  // The largest error over the pattern's triangles whose corners are all among those that count.
  template <class Counts>
  float largest(int level, int seams, const Counts& counts) const {
    const std::span<const std::uint32_t> indices = patterns_.indices(patterns_.run(shape_, level, seams));
    float largest = 0;
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      const std::array<Corner, 3> corners = {corner(indices[k]), corner(indices[k + 1]),
                                             corner(indices[k + 2])};
      if (!std::all_of(corners.begin(), corners.end(), counts)) continue;
      for_samples_on(corners.data(), grid_.width, grid_.depth,
                     [&](int x, int z, float y) { largest = std::max(largest, std::abs(y - height(x, z))); });
    }
    return largest;
  }

  float height(int x, int z) const { return grid_.heights[static_cast<std::size_t>(z) * grid_.width + x]; }
  Corner corner(std::uint32_t index) const {
    const auto width = static_cast<std::uint32_t>(grid_.width);
    const int x = patch_.i0 + static_cast<int>(index % width),
              z = patch_.j0 + static_cast<int>(index / width);
    return {x, z, height(x, z)};
  }

  const GroundGrid& grid_;
  const PatchPatterns& patterns_;
  PatchGrid::Patch patch_;
  int shape_;
};

}  // namespace

PatchErrors::PatchErrors(const GroundGrid& grid, const PatchGrid& cut, const PatchPatterns& patterns,
                         int levels, Progress& progress)
    : count_(static_cast<std::size_t>(levels)),
      levels_(cut.slots() * count_, 0.0F),
      seams_(cut.slots() * (count_ - 1) * 4, 0.0F) {
  progress.begin("measuring patches", static_cast<std::uint64_t>(cut.count()));
  tbb::parallel_for(tbb::blocked_range2d<int>(0, cut.down(), 0, cut.across()), [&](const auto& range) {
    for (int z = range.rows().begin(); z < range.rows().end(); ++z) {
      for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
        const Ruler ruler(grid, cut, patterns, cut.patch(x, z));
        float* const of_level = &levels_[cut.slot(x, z) * count_];
        float* const of_seam = &seams_[cut.slot(x, z) * (count_ - 1) * 4];
        for (int level = 1; level < levels; ++level) {
          of_level[level] = std::max(of_level[level - 1], ruler.whole(level));
          for (const Side side : {kNorth, kEast, kSouth, kWest}) {
            of_seam[4 * (level - 1) + side] = ruler.seam(level - 1, side);
          }
        }
        progress.advance();
      }
    }
  });
  progress.end();
}

Memory PatchErrors::memory() const {
  Memory memory = index_memory(levels_);
  memory += index_memory(seams_);
  return memory;
}

}  // namespace terrabench
