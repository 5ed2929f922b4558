// Frames of tessellated patches with factors of one's own.
#pragma once

#include <random>
#include <vector>

#include "lod/lod.h"
#include "lod/tessellated/patch_triangles.h"

namespace terrabench::test {

inline std::uint32_t packed(const std::array<int, 4>& sides, int inside) {
  std::uint32_t factors = static_cast<std::uint32_t>(inside) << (4 * tessellated::kInside);
  for (std::size_t s = 0; s < 4; ++s) factors |= static_cast<std::uint32_t>(sides[s]) << (4 * s);
  return factors;
}

// Of all patches of a field, each with the factors that choose(x, z) packs. The field must outlive it.
class PatchFrame {
 public:
  template <class Choose>
  PatchFrame(const Heightfield& field, int side, const Choose& choose)
      : field_(field), cut_{field.width, field.depth, side}, triangles_(cut_) {
    for (int z = 0; z < cut_.down(); ++z) {
      for (int x = 0; x < cut_.across(); ++x) {
        const PatchGrid::Patch patch = cut_.patch(x, z);
        patches_.push_back({static_cast<std::uint32_t>(patch.j0 * field.width + patch.i0), choose(x, z)});
        triangles_.append(patches_.back(), cut_.shape(patch), batches_);
      }
    }
  }

  Frame frame() const {
    return {.grid = grid_of(field_),
            .cell_x = field_.cell_x,
            .cell_z = field_.cell_z,
            .indices = triangles_.indices(),
            .batches = batches_,
            .patch_side = cut_.side,
            .patches = patches_,
            .stats = count(batches_, {}, 0)};
  }

 private:
  const Heightfield& field_;
  PatchGrid cut_;
  tessellated::PatchTriangles triangles_;
  std::vector<TessellatedPatch> patches_;
  std::vector<Batch> batches_;
};

// Any factors, unlike at the two patches of a side.
inline std::uint32_t random_factors(std::mt19937& random, int logs) {
  const auto any = [&](int least) {
    return least + static_cast<int>(random() % static_cast<unsigned>(logs + 1 - least));
  };
  return packed({any(0), any(0), any(0), any(0)}, any(1));
}

}  // namespace terrabench::test
