#include "results/claims/nearness.h"

#include <algorithm>
#include <cmath>

namespace terrabench {

double room_between(double a, double b) {
  const double distance = std::abs(b - a), scale = std::max(std::abs(a), std::abs(b));
  if (distance == 0) return 0;
  return std::isfinite(scale) ? std::min(1.0, distance / scale) : 1;
}

std::optional<double> room_in_range(double value, const Condition& condition) {
  const double low = condition.low, high = condition.high;
  if (low == high) return std::nullopt;
  const bool share = condition.kind == Condition::Kind::kWithin && low > 0 && high == 1;
  const bool below = std::isfinite(low) && low != 0, above = std::isfinite(high) && !share;
  if (!below && !above) return std::nullopt;
  return std::min(below ? room_between(low, value) : 1.0, above ? room_between(value, high) : 1.0);
}

}  // namespace terrabench
