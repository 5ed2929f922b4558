// Text from files, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace terrabench {

// The text with a space for each line break and tab, and '?' for each other control character (U+0000 to
// U+001F, U+007F to U+009F), which could move a terminal's cursor or hide what was printed. O(n).
std::string printable(std::string_view text);

}  // namespace terrabench
