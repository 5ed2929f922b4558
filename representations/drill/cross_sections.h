// Cross-sections of the terrain around a pixel and their union (Stuetzle & Franklin 2012, §2.2): 120 rays
// three degrees apart, sampled bilinearly at 1 … w samples from the pixel; the union takes the highest at
// each distance, the narrowest channel that any ray sees.
//
// The offsets and weights are the same for every pixel: they are computed once, and rays run in SIMD lanes
// without a branch. AVX2 and AVX-512 load two neighbours at once: 256·w loads per pixel, those of the lanes
// that only fill vectors included. Samples that need ground outside the terrain or without data are omitted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench {

class CrossSections {
 public:
  static constexpr int kRays = 120;
  // Rays beyond kRays repeat others, which does not change a maximum, so that all vector lengths divide
  // kLanes.
  static constexpr int kLanes = 128;
  // Stands for no data. Any bilinear weight of at least 10⁻⁸ of it outweighs every true height.
  static constexpr float kNothing = -1e30F;
  static bool is_sample(float height) { return height > -1e20F; }

  // Copies the field with a margin of w + 1, into bytes(). O(pixels), parallel. Needs reaches().
  CrossSections(const Heightfield& field, int w);
  static std::size_t bytes(const Heightfield& field, int w) {
    return row_length(field.width, w) * row_length(field.depth, w) * sizeof(float);
  }
  // Whether offsets fit 32 bits in a terrain of this width; up to 8 million samples they always do.
  static bool reaches(int width, int w) {
    return row_length(width, w) * (static_cast<std::size_t>(w) + 1) < std::size_t{1} << 31;
  }

  int w() const { return w_; }
  // The union at a pixel: w heights, the i-th at distance i + 1; is_sample() is false where no ray has one.
  void join(std::uint32_t pixel, std::span<float> out) const;
  // The rays themselves: kRays·w heights, ray by ray.
  void rays(std::uint32_t pixel, std::span<float> out) const;

 private:
  static std::size_t row_length(int samples, int w) {
    return static_cast<std::size_t>(samples) + 2 * (static_cast<std::size_t>(w) + 1);
  }
  const float* centre(std::uint32_t pixel) const {
    const std::size_t row = pixel / static_cast<std::uint32_t>(width_),
                      column = pixel % static_cast<std::uint32_t>(width_);
    const auto margin = static_cast<std::size_t>(w_) + 1;
    return heights_.data() + (row + margin) * stride_ + column + margin;
  }

  int width_, w_;
  std::size_t stride_;
  std::vector<float> heights_;
  // For distance i + 1 and ray m at i·kLanes + m: the sample to the north-west and how far past it, in
  // samples.
  std::vector<std::int32_t> offset_;
  std::vector<float> east_, south_;
};

}  // namespace terrabench
