#include "lod/cdlod/ranges.h"

#include <algorithm>
#include <limits>

namespace terrabench::cdlod {
namespace {

// Of distances: more than what floats round, on a GPU too.
constexpr double kSlack = 1e-5;
// Beyond, squares of distances would be no floats.
constexpr double kFarthest = 1e18;

// The least end of a range that begins at `begin`, as wide as the morph needs.
double least_end(const LevelNeeds& needs, double begin, double from) {
  const double until_from = begin + std::max(from - begin, 0.0) / kMorphStart;
  // Twice the triangle, so that vertices do not morph all at once.
  const double after_from = (begin * (1 - kMorphStart) + 2 * needs.triangle) / (1 - kMorphStart - 4 * kSlack);
  const double until_to = needs.to / (1 - kSlack) + needs.triangle;
  return std::max({needs.end, until_from, until_to, after_from});
}

}  // namespace

void fit_ranges(std::span<const LevelNeeds> needs, std::span<LevelRange> ranges) {
  double begin = 0, last_node = 0;
  for (std::size_t l = 0; l + 1 < ranges.size(); ++l) {
    ranges[l] = {};
    if (needs[l].end <= 0 && begin <= 0) continue;
    const double closed = begin > 0 ? (1 + kSlack) * (begin + last_node) : 0;
    const double end = std::min(least_end(needs[l], begin, std::max(needs[l].from, closed)), kFarthest);
    ranges[l] = {end,
                 {static_cast<float>(begin + kMorphStart * (end - begin)),
                  static_cast<float>((1 - kSlack) * (end - needs[l].triangle))}};
    begin = end;
    last_node = needs[l].node;
  }
  ranges.back() = {std::numeric_limits<double>::infinity(), {}};
}

}  // namespace terrabench::cdlod
