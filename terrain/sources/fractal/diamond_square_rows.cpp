#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/sources/fractal/diamond_square_rows.cpp"
#include "terrain/sources/fractal/diamond_square_rows.h"

#include <hwy/foreach_target.h>  // re-includes this file for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace terrabench::fractal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = hn::ScalableTag<float>;
using U = hn::RebindToUnsigned<F>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VU = hn::Vec<U>;

// displacement() of counter_random.h for the fine x of coarse points, every other one, vector by vector.
class Displacements {
 public:
  HWY_INLINE Displacements(const RowDisplacement& row, std::uint32_t odd)
      : flip_(hn::Set(U(), row.key.flip)),
        step_(hn::Set(U(), static_cast<std::uint32_t>(2 * hn::Lanes(U())) * kSpread)),
        range_(hn::Set(F(), row.range)) {
    const VU x = hn::Add(hn::ShiftLeft<1>(hn::Iota(U(), 0)), hn::Set(U(), odd));
    spread_ = hn::Add(hn::Mul(x, hn::Set(U(), kSpread)), hn::Set(U(), row.key.add));
  }
  HWY_INLINE VF next() {
    VU h = spread_;
    spread_ = hn::Add(spread_, step_);
    h = hn::Xor(hn::Mul(hn::Xor(h, hn::ShiftRight<16>(h)), hn::Set(U(), kMixA)), flip_);
    h = hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(U(), kMixB));
    h = hn::Xor(h, hn::ShiftRight<16>(h));
    const VF unit =
        hn::Mul(hn::ConvertTo(F(), hn::ShiftRight<8>(hn::BitCast(I(), h))), hn::Set(F(), 0x1p-23F));
    return hn::Mul(range_, unit);
  }

 private:
  VU spread_, flip_, step_;
  VF range_;
};

HWY_INLINE float moved(float a, float b, float c, float d, const RowDisplacement& row, int x) {
  return 0.25F * ((a + b) + (c + d)) + row.range * displacement(row.key, static_cast<std::uint32_t>(x));
}
HWY_INLINE VF moved(VF a, VF b, VF c, VF d, VF displacement) {
  const VF mean = hn::Mul(hn::Set(F(), 0.25F), hn::Add(hn::Add(a, b), hn::Add(c, d)));
  return hn::Add(mean, displacement);
}

void diamond_row_here(const float* north, const float* south, int points, RowDisplacement row,
                      float* middles) {
  const auto lanes = static_cast<int>(hn::Lanes(F()));
  Displacements displacements(row, 1);
  int i = 0;
  for (; i + lanes <= points - 1; i += lanes) {
    const VF middle = moved(hn::LoadU(F(), north + i), hn::LoadU(F(), north + i + 1),
                            hn::LoadU(F(), south + i), hn::LoadU(F(), south + i + 1), displacements.next());
    hn::StoreU(middle, F(), middles + i);
  }
  for (; i < points - 1; ++i) {
    middles[i] = moved(north[i], north[i + 1], south[i], south[i + 1], row, 2 * i + 1);
  }
}

void even_row_here(const float* coarse, const float* above, const float* below, int points,
                   RowDisplacement row, float* fine) {
  const auto lanes = static_cast<int>(hn::Lanes(F()));
  Displacements displacements(row, 1);
  int i = 0;
  for (; i + lanes <= points - 1; i += lanes) {
    const VF here = hn::LoadU(F(), coarse + i);
    const VF between = moved(here, hn::LoadU(F(), coarse + i + 1), hn::LoadU(F(), above + i),
                             hn::LoadU(F(), below + i), displacements.next());
    hn::StoreInterleaved2(here, between, F(), fine + 2 * i);
  }
  for (; i < points - 1; ++i) {
    fine[2 * i] = coarse[i];
    fine[2 * i + 1] = moved(coarse[i], coarse[i + 1], above[i], below[i], row, 2 * i + 1);
  }
  fine[2 * i] = coarse[i];
}

void odd_row_here(const float* north, const float* south, const float* middles, int points,
                  RowDisplacement row, float* fine) {
  const auto lanes = static_cast<int>(hn::Lanes(F()));
  Displacements displacements(row, 0);
  int i = 0;
  for (; i + lanes <= points - 1; i += lanes) {
    const VF east = hn::LoadU(F(), middles + i);
    const VF between = moved(hn::LoadU(F(), north + i), hn::LoadU(F(), south + i),
                             hn::LoadU(F(), middles + i - 1), east, displacements.next());
    hn::StoreInterleaved2(between, east, F(), fine + 2 * i);
  }
  for (; i < points - 1; ++i) {
    fine[2 * i] = moved(north[i], south[i], middles[i - 1], middles[i], row, 2 * i);
    fine[2 * i + 1] = middles[i];
  }
  fine[2 * i] = fine[0];
}

}  // namespace HWY_NAMESPACE
}  // namespace terrabench::fractal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrabench::fractal {

HWY_EXPORT(diamond_row_here);
HWY_EXPORT(even_row_here);
HWY_EXPORT(odd_row_here);

void diamond_row(const float* north, const float* south, int points, RowDisplacement row, float* middles) {
  HWY_DYNAMIC_DISPATCH(diamond_row_here)(north, south, points, row, middles);
}

void even_row(const float* coarse, const float* middles_above, const float* middles_below, int points,
              RowDisplacement row, float* fine) {
  HWY_DYNAMIC_DISPATCH(even_row_here)(coarse, middles_above, middles_below, points, row, fine);
}

void odd_row(const float* north, const float* south, const float* middles, int points, RowDisplacement row,
             float* fine) {
  HWY_DYNAMIC_DISPATCH(odd_row_here)(north, south, middles, points, row, fine);
}

}  // namespace terrabench::fractal
#endif
