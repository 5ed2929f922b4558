#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "representations/drill/cross_sections.cpp"
#include "representations/drill/cross_sections.h"

#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrabench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, CrossSections::kLanes>;

// Each sample and its eastern neighbour, for Lanes(F) offsets from the row's start.
HWY_INLINE void gather_neighbours(const float* row, const std::int32_t* offset, hn::Vec<F>& west,
                                  hn::Vec<F>& east) {
  const F f;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  // Each 64-bit lane loads a pair of neighbours: half as many loads, which take most of the time. Other
  // targets take the plain form below: they load lanes one by one, or their vectors have no fixed length.
  const hn::Repartition<std::int64_t, F> pair;
  const hn::Rebind<std::int32_t, decltype(pair)> half;
  const auto gather = [&](const std::int32_t* from) HWY_ATTR {
    const auto bytes = hn::ShiftLeft<2>(hn::PromoteTo(pair, hn::LoadU(half, from)));
    return hn::BitCast(f, hn::GatherOffset(pair, reinterpret_cast<const std::int64_t*>(row), bytes));
  };
  const auto low = gather(offset), high = gather(offset + hn::Lanes(half));
  west = hn::ConcatEven(f, high, low);
  east = hn::ConcatOdd(f, high, low);
#else
  const auto from = hn::LoadU(hn::RebindToSigned<F>(), offset);
  west = hn::GatherIndex(f, row, from);
  east = hn::GatherIndex(f, row + 1, from);
#endif
}

// No fused multiply-add: all instruction sets then agree to the bit.
void join(const float* centre, std::size_t stride, const std::int32_t* offset, const float* east,
          const float* south, int w, float* out) {
  const F f;
  const float* const below = centre + stride;
  for (int r = 0; r < w; ++r) {
    auto highest = hn::Set(f, CrossSections::kNothing);
    for (int m = 0; m < CrossSections::kLanes; m += static_cast<int>(hn::Lanes(f))) {
      const int at = r * CrossSections::kLanes + m;
      const auto x = hn::LoadU(f, east + at), z = hn::LoadU(f, south + at);
      auto nw = hn::Undefined(f), ne = nw, sw = nw, se = nw;
      gather_neighbours(centre, offset + at, nw, ne);
      gather_neighbours(below, offset + at, sw, se);
      const auto north = hn::Add(nw, hn::Mul(x, hn::Sub(ne, nw)));
      const auto there = hn::Add(sw, hn::Mul(x, hn::Sub(se, sw)));
      highest = hn::Max(highest, hn::Add(north, hn::Mul(z, hn::Sub(there, north))));
    }
    out[r] = hn::GetLane(hn::MaxOfLanes(f, highest));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terrabench {

HWY_EXPORT(join);

namespace {

// Moves a sample that lies on a grid line except for rounding onto it: otherwise a hole beside the line would
// count, and weights could be too small for kNothing.
double snap(double position) {
  const double nearest = std::round(position);
  return std::abs(position - nearest) < 1e-4 ? nearest : position;
}

// The sum of two products of which one may be `nothing` times zero.
float mix(float a, float b, float weight) { return a + weight * (b - a); }

}  // namespace

CrossSections::CrossSections(const Heightfield& field, int w) : width_(field.width), w_(w) {
  const std::size_t margin = static_cast<std::size_t>(w) + 1;
  stride_ = row_length(width_, w);
  heights_.resize(stride_ * row_length(field.depth, w));
  tbb::parallel_for(std::size_t{0}, heights_.size() / stride_, [&](std::size_t row) {
    float* const out = heights_.data() + row * stride_;
    std::fill_n(out, stride_, kNothing);
    if (row < margin || row >= margin + static_cast<std::size_t>(field.depth)) return;
    const float* const in = field.heights.data() + (row - margin) * static_cast<std::size_t>(width_);
    std::transform(in, in + width_, out + margin,
                   [](float h) { return Heightfield::is_no_data(h) ? kNothing : h; });
  });
  const std::size_t samples = static_cast<std::size_t>(w) * kLanes;
  offset_.resize(samples);
  east_.resize(samples);
  south_.resize(samples);
  for (std::size_t s = 0; s < samples; ++s) {
    const auto distance = static_cast<double>(s / kLanes + 1);
    const double angle = static_cast<double>(s % kLanes % kRays) * (2 * std::numbers::pi / kRays);
    const double x = snap(distance * std::cos(angle)), z = snap(distance * std::sin(angle));
    offset_[s] = static_cast<std::int32_t>(std::floor(z)) * static_cast<std::int32_t>(stride_) +
                 static_cast<std::int32_t>(std::floor(x));
    east_[s] = static_cast<float>(x - std::floor(x));
    south_[s] = static_cast<float>(z - std::floor(z));
  }
}

void CrossSections::join(std::uint32_t pixel, std::span<float> out) const {
  HWY_DYNAMIC_DISPATCH(join)
  (centre(pixel), stride_, offset_.data(), east_.data(), south_.data(), w_, out.data());
}

void CrossSections::rays(std::uint32_t pixel, std::span<float> out) const {
  const float* const at = centre(pixel);
  for (std::size_t ray = 0; ray < kRays; ++ray) {
    for (std::size_t r = 0; r < static_cast<std::size_t>(w_); ++r) {
      const std::size_t s = r * kLanes + ray;
      const float* const nw = at + offset_[s];
      const float* const sw = nw + stride_;
      out[ray * static_cast<std::size_t>(w_) + r] =
          mix(mix(nw[0], nw[1], east_[s]), mix(sw[0], sw[1], east_[s]), south_[s]);
    }
  }
}

}  // namespace terrabench
#endif
