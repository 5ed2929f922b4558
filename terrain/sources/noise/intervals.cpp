#include "terrain/sources/noise/intervals.h"

#include <algorithm>
#include <cmath>

namespace terrabench::noise {
namespace {

Interval hull(Interval a, Interval b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

Interval scale_offset(Interval a, float p, float q) {
  const float first = a.low * p + q, second = a.high * p + q;
  return {std::min(first, second), std::max(first, second)};
}

Interval multiply(Interval a, Interval b) {
  const float products[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  const auto [low, high] = std::minmax_element(std::begin(products), std::end(products));
  return {*low, *high};
}

// low + t (high - low) with t in [0, 1] may round past either end, by at most this share of the larger.
Interval mix(Interval high, Interval low) {
  const Interval both = hull(high, low);
  const float slack = 1e-6F * std::max(std::max(both.high, -both.high), std::max(both.low, -both.low));
  return {both.low - slack, both.high + slack};
}

// Bias and gain are monotone except for rounding.
Interval growing(Interval at_ends) { return {at_ends.low - 1e-6F, at_ends.high + 1e-6F}; }

float bias(float t, float p) {
  t = std::clamp(t, 0.0F, 1.0F);
  return t / (p * (1.0F - t) + 1.0F);
}

Interval bound(const IntervalStep& step, const Interval* at, const float* scratch, Interval y) {
  switch (step.op) {
    case Op::kInputY:
      return y;
    case Op::kConstant:
      return {scratch[step.a], scratch[step.a]};
    case Op::kScaleOffset:
      return scale_offset(at[step.a], step.p, step.q);
    case Op::kAdd:
      return {at[step.a].low + at[step.b].low, at[step.a].high + at[step.b].high};
    case Op::kMultiply:
      return multiply(at[step.a], at[step.b]);
    case Op::kClamp:
      return {std::clamp(at[step.a].low, step.p, step.q), std::clamp(at[step.a].high, step.p, step.q)};
    case Op::kMix:
      return mix(at[step.b], at[step.c]);
    case Op::kBias:
      return growing({bias(at[step.a].low, step.p), bias(at[step.a].high, step.p)});
    case Op::kGain:
      return {0.0F, 1.0F};
    default:
      return {step.p, step.q};  // a leaf of known range
  }
}

}  // namespace

int decide_step(std::span<const IntervalStep> steps, const float* scratch, Interval y, float p, float q) {
  Interval at[kMaxIntervalSteps];
  for (std::size_t i = 0; i < steps.size(); ++i) {
    at[i] = bound(steps[i], at, scratch, y);
    // Infinities may become NaN inside the interval, which its bounds do not show.
    if (!std::isfinite(at[i].low) || !std::isfinite(at[i].high)) return -1;
  }
  const Interval control = at[steps.size() - 1];
  // With a falloff the ends of the ramp are computed by a division: leave a margin for its rounding.
  const float margin = q == 0 ? 0.0F : 1e-5F * (q + std::abs(p));
  if (control.low >= p + q + margin) return 1;
  if (control.high < p - q - margin) return 0;
  return -1;
}

}  // namespace terrabench::noise
