#include "experiments/cross/knob_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace terrabench::cross {
namespace {

constexpr double kNothing = -1;
constexpr double kLongestStride = 4;      // octaves, while the target is not bracketed yet
constexpr double kNarrowest = 1.0 / 128;  // octaves: a bracket not worth dividing

// Errors of nothing at all lie this far below any target.
double octaves_of(double error, double target) { return std::log2(std::max(error, target * 1e-6) / target); }

}  // namespace

KnobSearch::KnobSearch(const Knob& knob)
    : knob_(knob), octaves_(std::abs(std::log2(knob.coarsest / knob.finest))) {}

double KnobSearch::knob_at(double place) const {
  const double value = knob_.finest * std::pow(knob_.coarsest / knob_.finest, place);
  return knob_.whole ? std::round(value) : value;
}

double KnobSearch::place_of(double knob) const {
  return octaves_ == 0 ? 0 : std::log(knob / knob_.finest) / std::log(knob_.coarsest / knob_.finest);
}

double KnobSearch::next_place(double target) const {
  if (errors_.empty()) return place_of(knob_.fallback);
  // The first that is too coarse, and the one before it.
  const auto coarse =
      std::find_if(errors_.begin(), errors_.end(), [&](const auto& t) { return t.second > target; });
  if (coarse == errors_.end()) {
    const auto& [place, error] = *errors_.rbegin();
    if (place >= 1 || error >= (1 - kSlack) * target) return kNothing;
    // As if the error went with the knob, and a little further, so that the target comes between.
    const double stride = std::clamp(0.25 - 1.2 * octaves_of(error, target), 0.25, kLongestStride);
    return std::min(1.0, place + stride / octaves_);
  }
  if (coarse == errors_.begin()) {
    const auto& [place, error] = *coarse;
    if (place <= 0) return kNothing;
    const double stride = std::clamp(0.25 + 1.2 * octaves_of(error, target), 0.25, kLongestStride);
    return std::max(0.0, place - stride / octaves_);
  }
  const auto& [fine_place, fine_error] = *std::prev(coarse);
  const auto& [coarse_place, coarse_error] = *coarse;
  const double width = coarse_place - fine_place;
  if (fine_error >= (1 - kSlack) * target || width * octaves_ <= kNarrowest) return kNothing;
  // Aims a little under the target, where an answer may lie.
  const double aim = std::log2(1 - kSlack / 2);
  const double low = octaves_of(fine_error, target), high = octaves_of(coarse_error, target);
  return fine_place + width * std::clamp((aim - low) / (high - low), 0.1, 0.9);
}

Tuned KnobSearch::find(double target, const std::function<double(double)>& error_at) {
  for (double place = next_place(target); place >= 0; place = next_place(target)) {
    const double knob = knob_at(place), real = place_of(knob);
    // Whole numbers run out before places do.
    if (errors_.contains(real)) break;
    errors_.emplace(real, error_at(knob));
  }
  const auto coarse =
      std::find_if(errors_.begin(), errors_.end(), [&](const auto& t) { return t.second > target; });
  const auto best = coarse == errors_.begin() ? coarse : std::prev(coarse);
  const auto& [place, error] = *best;
  const bool decided = coarse != errors_.end() || error >= (1 - kSlack) * target;
  return {knob_at(place), error, error <= target && decided};
}

}  // namespace terrabench::cross
