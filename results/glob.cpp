#include "results/glob.h"

namespace terrabench {

bool matches_glob(std::string_view pattern, std::string_view text) {
  // Only the last star needs to be tried again: whatever an earlier one could take, it can take too.
  std::size_t at = 0, read = 0, star = pattern.npos, taken = 0;
  while (read < text.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      taken = read;
    } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == text[read])) {
      ++at;
      ++read;
    } else if (star != pattern.npos) {
      at = star + 1;
      read = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == pattern.npos;
}

}  // namespace terrabench
