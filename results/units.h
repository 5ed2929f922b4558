// Conversion between the units that figures are measured in and shown in.
#pragma once

#include <string_view>

namespace terrabench {

// The factor from `from` to `to`. Times (s, ms, µs, ns) and bytes (B, kB, MB, GB) are converted; any other
// unit only to itself or to none; none to ×. Throws bad_input for other pairs, naming the metric and where it
// was read ("file:line").
double conversion(std::string_view from, std::string_view to, std::string_view metric,
                  std::string_view where);

}  // namespace terrabench
