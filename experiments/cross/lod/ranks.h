// Ranks of methods by a cost, and how far two orders agree.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace terrabench::cross {

// The rank of each cost: 1 + the number of smaller costs, so that equal costs share a rank. O(n²).
std::vector<int> ranks(std::span<const double> costs);

// The least share by which one cost must exceed another for their order to count: settings come in steps, so
// that methods are equal in error only to a few per cent.
inline constexpr double kFlipMargin = 0.05;

// Over all pairs of methods that have a cost in both orders.
struct Flips {
  std::size_t pairs = 0;
  // One method costs less than the other in one order and more in the other order, by kFlipMargin in both.
  std::size_t flipped = 0;
};
// One cost per method and order; nothing where a method has none. Both of the same length. O(n²).
Flips count_flips(std::span<const std::optional<double>> one, std::span<const std::optional<double>> other);

}  // namespace terrabench::cross
