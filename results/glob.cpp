#include "results/glob.h"

#include <algorithm>

#include "terrain/error.h"

namespace terrabench {

bool matches_glob(std::string_view pattern, std::string_view text) {
  // On a mismatch only the last star is extended: it can match all that an earlier star could.
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

bool matches_any(std::span<const std::string> patterns, std::string_view text) {
  return patterns.empty() || std::ranges::any_of(patterns, [&](const std::string& pattern) {
           return matches_glob(pattern, text);
         });
}

void demand_matches(std::span<const std::string> patterns, std::span<const std::string_view> names,
                    std::string_view kind) {
  for (const std::string& pattern : patterns) {
    const auto matched = [&](std::string_view name) { return matches_glob(pattern, name); };
    if (std::ranges::none_of(names, matched)) throw unknown_name(kind, pattern, names);
  }
}

}  // namespace terrabench
