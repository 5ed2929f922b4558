#include "lod/meters/knob_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

namespace terrabench {
namespace {

constexpr double kLongestStride = 4;      // octaves, before the target is bracketed
constexpr double kNarrowest = 1.0 / 128;  // octaves: a bracket not worth dividing
constexpr std::size_t kInterpolated =
    8;  // tries, after which brackets are halved: interpolation creeps along steps

using Tried = std::map<double, double>;  // errors by place on the knob: 0 finest … 1 coarsest

double knob_at(const Knob& knob, double place) {
  const double value = knob.finest * std::pow(knob.coarsest / knob.finest, place);
  return knob.whole ? std::round(value) : value;
}

double place_of(const Knob& knob, double value) {
  if (std::abs(std::log2(knob.coarsest / knob.finest)) == 0) return 0;
  return std::log(value / knob.finest) / std::log(knob.coarsest / knob.finest);
}

// An error of zero counts as far below any target.
double octaves_of(double error, double target) { return std::log2(std::max(error, target * 1e-6) / target); }

Tried::const_iterator first_too_coarse(const Tried& tried, double target) {
  return std::find_if(tried.begin(), tried.end(), [&](const auto& t) { return t.second > target; });
}

// The next place to try; nothing once the search is done.
std::optional<double> next_place(const Knob& knob, const Tried& tried, double target) {
  if (tried.empty()) return place_of(knob, knob.fallback);
  const double octaves = std::abs(std::log2(knob.coarsest / knob.finest));
  const auto coarse = first_too_coarse(tried, target);
  if (coarse == tried.end()) {
    const auto& [place, error] = *tried.rbegin();
    if (place >= 1 || error >= (1 - kKnobSlack) * target) return std::nullopt;
    // Steps as if the error were proportional to the knob, and slightly further, to bracket the target.
    const double stride = std::clamp(0.25 - 1.2 * octaves_of(error, target), 0.25, kLongestStride);
    return std::min(1.0, place + stride / octaves);
  }
  if (coarse == tried.begin()) {
    const auto& [place, error] = *coarse;
    if (place <= 0) return std::nullopt;
    const double stride = std::clamp(0.25 + 1.2 * octaves_of(error, target), 0.25, kLongestStride);
    return std::max(0.0, place - stride / octaves);
  }
  const auto& [fine_place, fine_error] = *std::prev(coarse);
  const auto& [coarse_place, coarse_error] = *coarse;
  const double width = coarse_place - fine_place;
  if (fine_error >= (1 - kKnobSlack) * target || width * octaves <= kNarrowest) return std::nullopt;
  if (tried.size() >= kInterpolated || std::isinf(coarse_error) || std::isinf(fine_error))
    return fine_place + width / 2;
  // Aims slightly below the target, inside the accepted range.
  const double aim = std::log2(1 - kKnobSlack / 2);
  const double low = octaves_of(fine_error, target), high = octaves_of(coarse_error, target);
  return fine_place + width * std::clamp((aim - low) / (high - low), 0.1, 0.9);
}

// The whole number beside `value`, which was tried: a finer one if its error exceeds the target, otherwise a
// coarser one. Nothing if that was tried too or is not on the knob.
std::optional<double> neighbour(const Knob& knob, const Tried& tried, double value, double target) {
  const double coarser = knob.coarsest > knob.finest ? 1 : -1;
  const double place = place_of(knob, value), next = value + (tried.at(place) > target ? -coarser : coarser);
  const double beside = place_of(knob, next);
  if (beside < 0 || beside > 1 || tried.contains(beside)) return std::nullopt;
  return next;
}

}  // namespace

Tuned search_knob(const Knob& knob, double target, const std::function<double(double)>& error_at) {
  Tried tried;
  while (const auto place = next_place(knob, tried, target)) {
    std::optional<double> value = knob_at(knob, *place);
    // Several places round to one whole number.
    if (tried.contains(place_of(knob, *value))) value = neighbour(knob, tried, *value, target);
    if (!value) break;
    tried.emplace(place_of(knob, *value), error_at(*value));
  }
  const auto coarse = first_too_coarse(tried, target);
  const auto& [place, error] = coarse == tried.begin() ? *coarse : *std::prev(coarse);
  const bool decided = coarse != tried.end() || error >= (1 - kKnobSlack) * target;
  return {knob_at(knob, place), error, std::isfinite(error) && error <= target && decided};
}

}  // namespace terrabench
