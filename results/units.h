// Units that figures are shown in, beside those they are measured in.
#pragma once

#include <string_view>

namespace terrabench {

// What a figure in `from` is multiplied by to be one in `to`. Times (s, ms, µs, ns) and bytes (B, kB, MB, GB)
// are converted, any other unit only to itself or to none, and what has none to ×. Throws bad_input, naming
// `what`, where the two do not measure the same.
double conversion(std::string_view from, std::string_view to, std::string_view what);

}  // namespace terrabench
