// How near a measured value is to the bounds that it must keep: of several conditions that hold, the one with
// the least room says most about the verdict. The room to a bound is |value - bound| ÷ max(|value|, |bound|),
// at most 1: 0 at the bound, 1 if the signs differ. The room of a condition is the least of those to its
// bounds. These do not count:
// - A lower bound of 0: counts, bytes, times and shares are never less.
// - The upper bound 1 of a condition `within` whose lower bound is above 0: the value is a share, and 1 is
// its
//   best value.
// A range of one value has no room, as an equality has none.
// O(1).
#pragma once

#include <optional>

#include "results/claims/claims.h"

namespace terrabench {

// Of a value that lies in the condition's range, whose ends may be infinite. None if it has one value or no
// bound that counts.
std::optional<double> room_in_range(double value, const Condition&);
// Between two values, in any order.
double room_between(double a, double b);

}  // namespace terrabench
