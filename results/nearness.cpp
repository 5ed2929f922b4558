#include "results/nearness.h"

#include <algorithm>
#include <cmath>

namespace terrabench {

double room_between(double a, double b) {
  const double distance = std::abs(b - a), scale = std::max(std::abs(a), std::abs(b));
  if (distance == 0) return 0;
  return std::isfinite(scale) ? std::min(1.0, distance / scale) : 1;
}

std::optional<double> room_in_range(double value, double low, double high) {
  if (low == high) return std::nullopt;
  const bool below = std::isfinite(low) && low != 0, above = std::isfinite(high);
  if (!below && !above) return std::nullopt;
  if (!below) return room_between(value, high);
  if (!above) return room_between(low, value);
  if (low > 0) {
    value = std::log(value);
    low = std::log(low);
    high = std::log(high);
  }
  return std::min(value - low, high - value) / ((high - low) / 2);
}

}  // namespace terrabench
