// Improved gradient noise (Perlin 2002) in SIMD: quintic fades, the twelve edge directions as gradients,
// chosen by an integer hash of the lattice point instead of a permutation table. Every operation is an
// exactly rounded float or an integer one, in a fixed order and without fused multiply-add, so all
// instruction sets agree bit for bit. Compiled once for each target: included by machine.cpp through
// Highway's foreach_target.
//
// Noise in a cell is written as n = n0 + fade(fy)(n1 - n0), plane k at height k of the cell being
// nk = Ak + Bk (fy - k), where A and B interpolate the gradients' x,z parts and y parts over x and z. Along a
// column in which x and z do not change, A and B of a lattice plane serve every sample next to it.
#if defined(TERRABENCH_GRADIENT_NOISE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRABENCH_GRADIENT_NOISE_INL_H
#undef TERRABENCH_GRADIENT_NOISE_INL_H
#else
#define TERRABENCH_GRADIENT_NOISE_INL_H
#endif

#include <hwy/highway.h>

#include "terrain/sources/noise/code.h"

HWY_BEFORE_NAMESPACE();
namespace terrabench::noise {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kMaxLanes>;
using I = hn::RebindToSigned<F>;
using U = hn::RebindToUnsigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using VU = hn::Vec<U>;
using MF = hn::Mask<F>;

struct Axis {
  VI cell;
  VF f0, f1, fade;  // distance to the cell's lower and upper lattice plane, weight of the upper
};

HWY_INLINE Axis axis_at(VI cell, VF t) {
  const F f;
  const VF inner =
      hn::Add(hn::Mul(hn::Sub(hn::Mul(t, hn::Set(f, 6.0F)), hn::Set(f, 15.0F)), t), hn::Set(f, 10.0F));
  return {cell, t, hn::Sub(t, hn::Set(f, 1.0F)), hn::Mul(hn::Mul(hn::Mul(t, t), t), inner)};
}

// Splits a coordinate into cell and fraction. Truncates and corrects instead of calling Floor(), whose sign
// of zero differs between targets.
HWY_INLINE Axis split(VF p) {
  const F f;
  const I i;
  p = hn::IfThenElseZero(hn::Lt(hn::Abs(p), hn::Set(f, kLatticeLimit)), p);
  const VI truncated = hn::ConvertTo(i, p);
  const VF whole = hn::ConvertTo(f, truncated);
  const MF above = hn::Gt(whole, p);
  const VF one = hn::Set(f, 1.0F);
  return axis_at(hn::Add(truncated, hn::VecFromMask(i, hn::RebindMask(i, above))),
                 hn::Sub(p, hn::Sub(whole, hn::IfThenElseZero(above, one))));
}

HWY_INLINE VU hash_xz(VU xz) {
  const U u;
  return hn::Mul(hn::Xor(xz, hn::ShiftRight<16>(xz)), hn::Set(u, kMixXz));
}

HWY_INLINE VU hash_y(VU xzy) {
  const U u;
  return hn::Mul(hn::Xor(xzy, hn::ShiftRight<15>(xzy)), hn::Set(u, kMixY));
}

// Values of the four vertical lattice lines around a point that all planes share: hash, x,z weight, weighted
// distances.
struct Line {
  VU hash;
  VF weight, x, z;
};

HWY_INLINE void lines(const Axis& x, const Axis& z, VU seed, Line (&line)[4]) {
  const F f;
  const U u;
  const VU x0 = hn::Mul(hn::BitCast(u, x.cell), hn::Set(u, kLatticeX));
  const VU z0 = hn::Xor(hn::Mul(hn::BitCast(u, z.cell), hn::Set(u, kLatticeZ)), seed);
  const VU x1 = hn::Add(x0, hn::Set(u, kLatticeX));
  const VU z1 =
      hn::Xor(hn::Add(hn::Mul(hn::BitCast(u, z.cell), hn::Set(u, kLatticeZ)), hn::Set(u, kLatticeZ)), seed);
  const VF one = hn::Set(f, 1.0F);
  const VF u0 = hn::Sub(one, x.fade), v0 = hn::Sub(one, z.fade);
  line[0].hash = hash_xz(hn::Xor(x0, z0));
  line[1].hash = hash_xz(hn::Xor(x1, z0));
  line[2].hash = hash_xz(hn::Xor(x0, z1));
  line[3].hash = hash_xz(hn::Xor(x1, z1));
  line[0].weight = hn::Mul(u0, v0);
  line[1].weight = hn::Mul(x.fade, v0);
  line[2].weight = hn::Mul(u0, z.fade);
  line[3].weight = hn::Mul(x.fade, z.fade);
  for (int c = 0; c < 4; ++c) {
    line[c].x = hn::Mul(line[c].weight, c % 2 == 0 ? x.f0 : x.f1);
    line[c].z = hn::Mul(line[c].weight, c < 2 ? z.f0 : z.f1);
  }
}

struct Plane {
  VF a, b;  // A and B of the header comment
};

// The edge direction of a lattice point has one zero component, drawn from the hash's low 29 bits in equal
// thirds, and the signs of the other two in the top bits.
HWY_INLINE Plane corner(const Line& line, VU y) {
  const F f;
  const U u;
  const VU h = hash_y(hn::Xor(line.hash, y));
  const VF sign = hn::BitCast(f, hn::Set(u, 0x80000000U));
  const VF sign_x = hn::And(hn::BitCast(f, h), sign);
  const VF sign_y = hn::And(hn::BitCast(f, hn::ShiftLeft<1>(h)), sign);
  const VF sign_z = hn::And(hn::BitCast(f, hn::ShiftLeft<2>(h)), sign);
  const I i;
  const VI third = hn::BitCast(i, hn::And(h, hn::Set(u, 0x1FFFFFFFU)));
  const MF no_x = hn::RebindMask(f, hn::Lt(third, hn::Set(i, kThird)));
  const MF no_z = hn::RebindMask(f, hn::Gt(third, hn::Set(i, 2 * kThird)));
  const VF gx = hn::IfThenZeroElse(no_x, hn::Xor(line.x, sign_x));
  const VF gz = hn::IfThenZeroElse(no_z, hn::Xor(line.z, sign_z));
  const VF gy = hn::IfThenElseZero(hn::Or(no_x, no_z), hn::Xor(line.weight, sign_y));
  return {hn::Add(gx, gz), gy};
}

HWY_INLINE Plane plane(const Line (&line)[4], VU y) {
  const Plane c0 = corner(line[0], y), c1 = corner(line[1], y);
  const Plane c2 = corner(line[2], y), c3 = corner(line[3], y);
  return {hn::Add(hn::Add(c0.a, c1.a), hn::Add(c2.a, c3.a)),
          hn::Add(hn::Add(c0.b, c1.b), hn::Add(c2.b, c3.b))};
}

HWY_INLINE VF between(const Axis& y, const Plane& low, const Plane& high) {
  const F f;
  const VF n0 = hn::Add(low.a, hn::Mul(low.b, y.f0));
  const VF n1 = hn::Add(high.a, hn::Mul(high.b, y.f1));
  return hn::Mul(hn::Add(n0, hn::Mul(y.fade, hn::Sub(n1, n0))), hn::Set(f, kNormalise));
}

HWY_INLINE VF gradient_noise(const Axis& x, const Axis& y, const Axis& z, VU seed) {
  const U u;
  Line line[4];
  lines(x, z, seed, line);
  const VU y0 = hn::Mul(hn::BitCast(u, y.cell), hn::Set(u, kLatticeY));
  const Plane low = plane(line, y0);
  const Plane high = plane(line, hn::Add(y0, hn::Set(u, kLatticeY)));
  return between(y, low, high);
}

HWY_INLINE VF gradient_noise(VF px, VF py, VF pz, VU seed) {
  return gradient_noise(split(px), split(py), split(pz), seed);
}

// Computes the planes from `base` on, rounded up to whole vectors on the side to which y moves, where the
// next batch uses them.
HWY_INLINE void fill_window(VF px, VF pz, std::uint32_t seed, std::int32_t base, std::uint32_t planes,
                            bool rising, PlaneWindow& window) {
  const F f;
  const I i;
  const U u;
  Line line[4];
  lines(split(px), split(pz), hn::Set(u, seed), line);
  window.count = (planes + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  window.base = rising ? base : base + static_cast<std::int32_t>(planes - window.count);
  for (std::uint32_t k = 0; k < window.count; k += static_cast<std::uint32_t>(hn::Lanes(f))) {
    const VI at = hn::Iota(i, window.base + static_cast<std::int32_t>(k));
    const Plane p = plane(line, hn::Mul(hn::BitCast(u, at), hn::Set(u, kLatticeY)));
    hn::Store(p.a, f, window.a + k);
    hn::Store(p.b, f, window.b + k);
  }
}

// Noise at (px, py[i], pz) for `count` samples, a multiple of the vector size, py rising or falling
// monotonically. `window` holds planes of the same px, pz and seed, or none. Returns false, with nothing
// written, when the samples are too sparse to share planes.
HWY_INLINE bool gradient_noise_along_y(VF px, const float* HWY_RESTRICT py, VF pz, std::uint32_t seed,
                                       std::uint32_t count, PlaneWindow& window, float* HWY_RESTRICT out) {
  const F f;
  const I i;
  const auto n = static_cast<std::uint32_t>(hn::Lanes(f));
  const float first = py[0], last = py[count - 1];
  // False for NaN.
  if (!(first > -kPlaneLimit && first < kPlaneLimit && last > -kPlaneLimit && last < kPlaneLimit)) {
    return false;
  }
  const bool rising = first < last;
  const float low = rising ? first : last, span = rising ? last - first : first - last;
  if (span * kPlaneCost > static_cast<float>(count)) return false;
  const std::int32_t lowest = static_cast<std::int32_t>(low) - 1;  // at most the lowest cell
  const auto planes = static_cast<std::uint32_t>(span) + 5;        // past the plane above the highest
  if (lowest < window.base || static_cast<std::uint32_t>(lowest - window.base) + planes > window.count) {
    fill_window(px, pz, seed, lowest, planes, rising, window);
  }
  alignas(64) std::int32_t cells[kMaxLanes];
  for (std::uint32_t s = 0; s < count; s += n) {
    const Axis y = split(hn::Load(f, py + s));
    hn::Store(y.cell, i, cells);
    const std::int32_t from = cells[0] < cells[n - 1] ? cells[0] : cells[n - 1];
    const std::int32_t to = cells[0] < cells[n - 1] ? cells[n - 1] : cells[0];
    const float *ka = window.a + (from - window.base), *kb = window.b + (from - window.base);
    Plane lower{hn::Set(f, ka[0]), hn::Set(f, kb[0])}, upper{hn::Set(f, ka[1]), hn::Set(f, kb[1])};
    for (std::int32_t cell = from + 1; cell <= to; ++cell) {
      ++ka, ++kb;
      const MF here = hn::RebindMask(f, hn::Eq(y.cell, hn::Set(i, cell)));
      lower = {hn::IfThenElse(here, hn::Set(f, ka[0]), lower.a),
               hn::IfThenElse(here, hn::Set(f, kb[0]), lower.b)};
      upper = {hn::IfThenElse(here, hn::Set(f, ka[1]), upper.a),
               hn::IfThenElse(here, hn::Set(f, kb[1]), upper.b)};
    }
    hn::Store(between(y, lower, upper), f, out + s);
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench::noise
HWY_AFTER_NAMESPACE();
#endif
