#include "experiments/cross/ranks.h"

#include <algorithm>

namespace terrabench::cross {
namespace {

bool clearly_less(double a, double b) { return a * (1 + kFlipMargin) <= b && a < b; }

}  // namespace

std::vector<int> ranks(std::span<const double> costs) {
  std::vector<int> ranks;
  for (const double cost : costs) {
    ranks.push_back(1 + static_cast<int>(std::ranges::count_if(costs, [&](double c) { return c < cost; })));
  }
  return ranks;
}

Flips count_flips(std::span<const std::optional<double>> one, std::span<const std::optional<double>> other) {
  Flips flips;
  for (std::size_t a = 0; a < one.size(); ++a) {
    for (std::size_t b = a + 1; b < one.size(); ++b) {
      if (!one[a] || !one[b] || !other[a] || !other[b]) continue;
      ++flips.pairs;
      flips.flipped += (clearly_less(*one[a], *one[b]) && clearly_less(*other[b], *other[a])) ||
                       (clearly_less(*one[b], *one[a]) && clearly_less(*other[a], *other[b]));
    }
  }
  return flips;
}

}  // namespace terrabench::cross
