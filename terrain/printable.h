// Text from files: its characters, and made fit for a terminal.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace terrabench {

// The text with a space for each control character (C0, DEL, C1), which could move a terminal's cursor or
// hide what was printed, and for the two characters that XML lacks. O(n).
std::string printable(std::string_view utf8);

struct Character {
  char32_t code;
  std::size_t bytes;
};
// The first character of a text that is not empty; nothing where it is not UTF-8 (RFC 3629).
std::optional<Character> decode(std::string_view text);

}  // namespace terrabench
