// The errors from which tessellated patches choose factors, measured at every sample: of each patch's inner
// square and strips, for every combination of factors that shapes them, and of each side alone. Sides that
// patches share are kept once, with a sphere around their samples.
//
// A sample on a side counts for the side alone, not for the strips, so that a strip's error is 0 where the
// inside has one segment per cell, whatever the side's factor is. O(samples · log² side) to build, in
// parallel; 4·log side·(4·log side + 5) bytes per patch, and for its sides 8·log side + 32.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/tessellated/patch_triangles.h"
#include "terrain/progress.h"

namespace terrabench::tessellated {

struct Sphere {
  glm::vec3 centre{0};
  float radius = 0;  // metres
};

class FactorErrors {
 public:
  // The sides' spheres alone if not `measured`.
  FactorErrors(const GroundGrid&, const PatchGrid&, const PatchTriangles&, bool measured, Progress&);

  // Measures these patches again.
  void measure(const GroundGrid&, const PatchGrid&, const PatchTriangles&, const PatchGrid::PatchRect&);

  // The number of a patch's side; `slot`: PatchGrid::slot().
  std::size_t side(std::uint32_t slot, int side) const {
    if (side == kSouth || side == kEast) slot += offsets_[static_cast<std::size_t>(side)];
    return 2 * std::size_t{slot} + (side == kNorth || side == kSouth ? 0 : 1);
  }
  std::size_t sides() const { return spheres_.size(); }
  const Sphere& sphere(std::size_t side) const { return spheres_[side]; }
  // Metres; by logarithms of factors.
  float of_side(std::size_t side, int outside) const {
    return of_sides_[side * static_cast<std::size_t>(logs_ + 1) + static_cast<std::size_t>(outside)];
  }
  // The larger of both strips' errors if the insides have the side's factor.
  float beside(std::size_t side, int outside) const;
  float of_inner(std::uint32_t slot, int inside) const { return of_patches_[place(slot, inside)]; }
  float of_strip(std::uint32_t slot, int inside, int side, int outside) const {
    return of_patches_[place(slot, inside) + static_cast<std::size_t>(1 + side * (logs_ + 1) + outside)];
  }
  Memory memory() const { return index_memory(spheres_, of_sides_, of_patches_); }

 private:
  std::size_t place(std::uint32_t slot, int inside) const {
    return (std::size_t{slot} * static_cast<std::size_t>(logs_) + static_cast<std::size_t>(inside - 1)) *
           static_cast<std::size_t>(4 * logs_ + 5);
  }
  void measure_side(const GroundGrid&, const PatchGrid&, int x, int z, int side);
  void measure_patch(const GroundGrid&, const PatchGrid&, const PatchTriangles&, int x, int z);

  int logs_;
  bool measured_;
  std::array<std::int32_t, 4> offsets_;
  std::vector<Sphere> spheres_;
  std::vector<float> of_sides_, of_patches_;
};

}  // namespace terrabench::tessellated
