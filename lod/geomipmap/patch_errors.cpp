#include "lod/geomipmap/patch_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "terrain/memory.h"

namespace terrabench {
namespace {

float whole(const PatchRuler& ruler, int level) {
  return ruler.largest(level, 0, [](const Corner&) { return true; });
}

// The error of the row of cells at a side, which may be narrower than the others.
float seam(const PatchRuler& ruler, int level, Side side) {
  const PatchGrid::Patch& patch = ruler.patch();
  const int step = 1 << level;
  const bool across = side == kEast || side == kWest;
  const int cells = across ? patch.columns : patch.rows, low = across ? patch.i0 : patch.j0;
  if (cells <= step) {  // a seam across changes the same triangles
    const int alone = 1 << side, both = alone | 1 << (side ^ 2);
    return std::max(ruler.largest(level, alone, [](const Corner&) { return true; }),
                    ruler.largest(level, both, [](const Corner&) { return true; }));
  }
  const int last = low + (cells - 1) / step * step;
  return ruler.largest(level, 1 << side, [&](const Corner& c) {
    const int at = across ? c.x : c.z;
    return side == kNorth || side == kWest ? at <= low + step : at >= last;
  });
}

}  // namespace

PatchErrors::PatchErrors(const GroundGrid& grid, const PatchGrid& cut, const PatchTree& tree,
                         const PatchPatterns& patterns, int levels, Progress& progress)
    : steps_(static_cast<std::size_t>(levels - 1)),
      errors_(cut.count()),
      seams_(cut.slots() * steps_ * 4, 0.0F) {
  progress.begin("measuring patches", static_cast<std::uint64_t>(cut.count()));
  tbb::parallel_for(std::size_t{0}, cut.count(), [&](std::size_t k) {
    measure({grid, cut, patterns, cut.patch(tree.places()[k].slot)}, tree, k);
    progress.advance();
  });
  progress.end();
}

void PatchErrors::measure(const PatchRuler& ruler, const PatchTree& tree, std::size_t patch) {
  float* const of_seam = &seams_[tree.places()[patch].slot * steps_ * 4];
  errors_[patch].fill(std::numeric_limits<float>::infinity());
  float error = 0;
  for (int level = 1; level <= static_cast<int>(steps_); ++level) {
    error = std::max(error, whole(ruler, level));
    errors_[patch][static_cast<std::size_t>(level - 1)] = error;
    for (const Side side : {kNorth, kEast, kSouth, kWest}) {
      of_seam[4 * (level - 1) + side] = seam(ruler, level - 1, side);
    }
  }
}

void PatchErrors::measure(const GroundGrid& grid, const PatchGrid& cut, const PatchTree& tree,
                          const PatchPatterns& patterns, const PatchGrid::PatchRect& patches) {
  tbb::parallel_for(patches.z0, patches.z1 + 1, [&](int z) {
    for (int x = patches.x0; x <= patches.x1; ++x)
      measure({grid, cut, patterns, cut.patch(x, z)}, tree, tree.number(x, z));
  });
}

Memory PatchErrors::memory() const { return index_memory(errors_, seams_); }

}  // namespace terrabench
