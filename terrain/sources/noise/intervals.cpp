// Interval arithmetic over one batch of a column: proves that a step is wholly 0 or wholly 1 without
// evaluating its control. Float rounding is monotone, so that the rounded ends of an interval, computed by
// the machine's own operations, bound every rounded value inside.
#include <algorithm>
#include <cmath>

#include "terrain/sources/noise/code.h"

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

// Bias is monotone except for rounding.
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
      return hull(at[step.b], at[step.c]);
    case Op::kBias:
      return growing({bias(at[step.a].low, step.p), bias(at[step.a].high, step.p)});
    default:
      return {step.p, step.q};  // a leaf of known range
  }
}

}  // namespace

int decide_step(std::span<const IntervalStep> steps, const float* scratch, Interval y, float p) {
  Interval at[kMaxIntervalSteps];
  for (std::size_t i = 0; i < steps.size(); ++i) {
    at[i] = bound(steps[i], at, scratch, y);
    // Infinities may become NaN inside the interval, which its bounds do not show.
    if (!std::isfinite(at[i].low) || !std::isfinite(at[i].high)) return -1;
  }
  const Interval control = at[steps.size() - 1];
  if (control.low >= p) return 1;
  if (control.high < p) return 0;
  return -1;
}

}  // namespace terrabench::noise
