// Measures the vertical distance between a patch's triangles and the full terrain, at every sample on them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lod/geomipmap/patch_patterns.h"
#include "lod/plan_triangle.h"
#include "terrain/frame.h"

namespace terrabench {

class PatchRuler {
 public:
  using Triangle = std::array<Corner, 3>;

  PatchRuler(const GroundGrid& grid, const PatchGrid& cut, const PatchPatterns& patterns,
             const PatchGrid::Patch& patch)
      : grid_(grid), patterns_(patterns), patch_(patch), side_(cut.side), shape_(cut.shape(patch)) {}

  const PatchGrid::Patch& patch() const { return patch_; }
  bool is_whole() const { return shape_ == 0; }

  // The largest error at the samples of those triangles of the pattern whose corners all satisfy `counts`,
  // metres.
  template <class Counts>
  float largest(int level, int seams, const Counts& counts) const {
    float largest = 0;
    for_triangles(level, seams, [&](const Triangle& corners) {
      if (std::all_of(corners.begin(), corners.end(), counts)) largest = std::max(largest, error(corners));
    });
    return largest;
  }

  // Calls use(triangle, error in metres) for all triangles of the pattern, morphed.
  template <class Use>
  void measure(int level, int seams, const PatchMorph& morph, const Use& use) {
    const int step = 1 << level, across = patch_.columns + 1;
    moved_.resize(static_cast<std::size_t>(across) * (patch_.rows + 1));
    const auto next = [step](int at, int last) { return at == last ? last + 1 : std::min(at + step, last); };
    for (int z = 0; z <= patch_.rows; z = next(z, patch_.rows)) {
      for (int x = 0; x <= patch_.columns; x = next(x, patch_.columns)) {
        moved_[static_cast<std::size_t>(z) * across + x] = morphed_height(
            grid_, side_, morph, level, {patch_.i0, patch_.j0}, {patch_.i0 + x, patch_.j0 + z});
      }
    }
    for_triangles(level, seams, [&](Triangle corners) {
      for (Corner& c : corners) {
        c.y = moved_[static_cast<std::size_t>(c.z - patch_.j0) * across + (c.x - patch_.i0)];
      }
      use(corners, error(corners));
    });
  }

 private:
  template <class Use>
  void for_triangles(int level, int seams, const Use& use) const {
    const std::span<const std::uint32_t> indices = patterns_.indices(patterns_.pattern(shape_, level, seams));
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      use(Triangle{corner(indices[k]), corner(indices[k + 1]), corner(indices[k + 2])});
    }
  }
  float error(const Triangle& corners) const {
    float largest = 0;
    for_samples_on(corners.data(), grid_.width, grid_.depth,
                   [&](int x, int z, float y) { largest = std::max(largest, std::abs(y - height(x, z))); });
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
  int side_, shape_;
  std::vector<float> moved_;
};

}  // namespace terrabench
