#include "results/store/glob.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "terrain/error.h"
#include "terrain/spelling.h"

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

namespace {

// The names as the pattern would have them: 'hybrid.*' of hybrid.caves for 'hybird.*'.
std::vector<std::string> like(std::string_view pattern, std::span<const std::string_view> names) {
  const std::size_t star = std::min(pattern.find_first_of("*?"), pattern.size());
  const std::string_view rest = pattern.substr(star);
  std::vector<std::string> all;
  for (const std::string_view name : names) {
    std::string one(rest.empty() ? name : name.substr(0, star));
    all.push_back(one.append(rest));
  }
  return all;
}

}  // namespace

void demand_matches(std::span<const std::string> patterns, std::span<const std::string_view> names,
                    std::string_view kind, std::string_view listing) {
  for (const std::string& pattern : patterns) {
    const auto matched = [&](std::string_view name) { return matches_glob(pattern, name); };
    if (std::ranges::any_of(names, matched)) continue;
    const std::vector<std::string> known = like(pattern, names);
    throw usage_error(
        fmt::format("unknown {} '{}'{}", kind, pattern,
                    suggestion(pattern, std::vector<std::string_view>(known.begin(), known.end()))),
        "", fmt::format("'{}' names all {}", listing, names.size()));
  }
}

}  // namespace terrabench
