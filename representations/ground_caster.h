// A ray caster from a ground that casts single rays.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <memory>

#include "representations/ray_cast.h"
#include "terrain/memory.h"

namespace terrabench {

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

}  // namespace terrabench
