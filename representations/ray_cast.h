// Closest hits of arbitrary rays on a representation, from what it holds and without a mesh.
//
//   heightmap, drill                     the two triangles of each square of samples, as mesh() draws them
//   layered_stack, voxel, dense_voxel    blocks: each column's spans, as wide as the column
//   ght                                  squares and faces, as mesh() draws them: ght/ght_rays.h
//   implicit                             the zero set of the field, which mesh() approximates:
//                                        implicit/field_rays.h
//
// Rays walk over the columns in plan (Amanatides & Woo 1987) and skip blocks of 4^l × 4^l columns whose
// highest solid point lies below them (maximum mipmaps; Tevs, Ihrke & Seidel 2008). No ray slips through an
// edge between columns: whether it is in the solid is carried from column to column, and any change is a hit.
// A procedural_mesh is a mesh already, with no columns to walk over: its caster is null.
// Any mesh is cast by Embree: renderers/raytrace/ray_index.h.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <memory>
#include <span>

#include "representations/representation.h"
#include "terrain/memory.h"
#include "terrain/solid.h"

namespace terrabench {

class RayCaster {
 public:
  virtual ~RayCaster() = default;

  // The distance of each ray's first hit in [near, far], in lengths of its direction; infinite for none. The
  // surface counts from both sides, and includes the walls and the floor that close mesh(). A ray that is not
  // finite, or has no direction, hits nothing. Both spans have the same size. Parallel, thread-safe, equal
  // for every number of threads. O(√columns) per ray at worst, O(log columns) where it passes well above the
  // ground.
  virtual void closest(std::span<const Ray>, std::span<float> distances) const = 0;
  // Heap bytes held besides the representation's own.
  virtual std::size_t bytes() const = 0;
};

// A ray caster from a ground that casts single rays.
// Ground has
//   double closest(const Ray&) const;     thread-safe; the distance to the first hit, infinite for none
//   std::size_t bytes() const;            heap bytes that it holds
template <class Ground>
class GroundCaster final : public RayCaster {
 public:
  template <class... From>
  explicit GroundCaster(const From&... from) : ground_(from...) {}

  void closest(std::span<const Ray> rays, std::span<float> distances) const override {
    constexpr std::size_t kGrain = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), kGrain), [&](const auto& range) {
      for (std::size_t r = range.begin(); r < range.end(); ++r) {
        distances[r] = static_cast<float>(ground_.closest(rays[r]));
      }
    });
  }
  std::size_t bytes() const override { return heap_bytes(this) + ground_.bytes(); }

 private:
  Ground ground_;
};

class Heightmap;

// What Representation::ray_caster() gives for heights, and for columns. Take a fifteenth of the bytes of the
// heights; for columns a copy of their spans. Null for heights without area. O(columns + spans).
std::unique_ptr<RayCaster> height_ray_caster(const Heightmap&);
std::unique_ptr<RayCaster> span_ray_caster(const Representation&, const ColumnGrid&);

}  // namespace terrabench
