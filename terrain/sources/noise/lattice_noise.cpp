// Compiled for each instruction set, chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/sources/noise/lattice_noise.cpp"
#include "terrain/sources/noise/lattice_noise.h"

#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

#include "terrain/sources/noise/gradient_noise_inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrabench::noise {
namespace HWY_NAMESPACE {

// Point / 2^bits + offset, in cells. Both fractions are whole multiples of a power of two, of 15 and 8 bits
// at most, so that their sum is exact.
HWY_INLINE Axis lattice_axis(VI point, int bits, float offset) {
  const F f;
  const I i;
  const auto whole = static_cast<std::int32_t>(offset);
  const std::int32_t cell = 1 << bits;
  const VF fraction = hn::Mul(hn::ConvertTo(f, hn::And(point, hn::Set(i, cell - 1))),
                              hn::Set(f, 1.0F / static_cast<float>(cell)));
  const VF sum = hn::Add(fraction, hn::Set(f, offset - static_cast<float>(whole)));
  const VF one = hn::Set(f, 1.0F);
  const MF over = hn::Ge(sum, one);
  const VI below = hn::Add(hn::ShiftRightSame(point, bits), hn::Set(i, whole));
  return axis_at(hn::Sub(below, hn::VecFromMask(i, hn::RebindMask(i, over))),
                 hn::Sub(sum, hn::IfThenElseZero(over, one)));
}

void lattice_points(std::span<const Octave> octaves, int cell_bits, std::span<const std::int32_t> x,
                    std::span<const std::int32_t> z, float* out) {
  const F f;
  const I i;
  const std::size_t lanes = hn::Lanes(f);
  alignas(64) std::int32_t xs[kMaxLanes] = {}, zs[kMaxLanes] = {};
  alignas(64) float values[kMaxLanes];
  for (std::size_t k = 0; k < x.size(); k += lanes) {
    const std::size_t n = x.size() - k < lanes ? x.size() - k : lanes;
    for (std::size_t lane = 0; lane < n; ++lane) {
      xs[lane] = x[k + lane];
      zs[lane] = z[k + lane];
    }
    const VI px = hn::Load(i, xs), pz = hn::Load(i, zs);
    VF sum = hn::Zero(f);
    int bits = cell_bits;
    for (const Octave& octave : octaves) {
      const VF noise =
          gradient_noise(lattice_axis(px, bits, octave.offset_x), split(hn::Set(f, octave.offset_y)),
                         lattice_axis(pz, bits, octave.offset_z), hn::Set(U(), octave.seed));
      sum = hn::Add(sum, hn::Mul(noise, hn::Set(f, octave.weight)));
      --bits;
    }
    hn::Store(sum, f, values);
    for (std::size_t lane = 0; lane < n; ++lane) out[k + lane] = values[lane];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench::noise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cassert>
#include <cmath>

#include "terrain/error.h"

namespace terrabench::noise {

HWY_EXPORT(lattice_points);

LatticeNoise::LatticeNoise(const LatticeFractal& fractal) : cell_bits_(fractal.cell_bits) {
  if (fractal.cell_bits < 1 || fractal.cell_bits > 15 || fractal.octaves < 1 ||
      fractal.octaves > fractal.cell_bits + 1 || !(fractal.gain > 0 && fractal.gain < 1)) {
    throw usage_error(
        "the octaves are out of range", "lattice noise",
        "choose 1 to 15 bits for the first cell, at most one octave more than bits, a gain in (0, 1)");
  }
  octaves_ = octaves({.seed = fractal.seed,
                      .frequency = std::ldexp(1.0F, -fractal.cell_bits),
                      .octaves = fractal.octaves,
                      .gain = fractal.gain});
}

void LatticeNoise::points(std::span<const std::int32_t> x, std::span<const std::int32_t> z,
                          std::span<float> out) const {
  assert(x.size() == out.size() && z.size() == out.size());
  HWY_DYNAMIC_DISPATCH(lattice_points)(octaves_, cell_bits_, x, z, out.data());
}

}  // namespace terrabench::noise
#endif
