// Text from files, made fit for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace terrabench {

// The text with a space for each control character (C0, DEL, C1), which could move a terminal's cursor or
// hide what was printed, and for the two characters that XML lacks. O(n).
std::string printable(std::string_view utf8);

}  // namespace terrabench
