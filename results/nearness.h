// How near a measured value is to the bound that it must keep: of several conditions that hold, the one with
// the least room says most about the verdict. A room is 0 at the bound and 1 as far from it as can be, so
// that rooms of different units and kinds compare:
// - A range with two bounds: the distance to the nearer one, as a share of the distance from the middle. If
//   both are positive, distances are those of logarithms: the middle of [0.5, 2] is 1.
// - A range with one bound, or a value that must be below another: 1 - smaller ÷ larger, at most 1 where the
//   signs differ or one is 0. A lower bound of 0 does not count: counts, bytes, times and shares are never
//   less.
// - A range of one value has no room, as an equality has none.
// O(1).
#pragma once

#include <optional>

namespace terrabench {

// Of a value that lies in [low, high]; either may be infinite. None if low = high, or if nothing bounds it.
std::optional<double> room_in_range(double value, double low, double high);
// Of a < b.
double room_between(double a, double b);

}  // namespace terrabench
