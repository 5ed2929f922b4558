// Patterns for names: * stands for any characters, ? for one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace terrabench {

// "hybrid.*" matches "hybrid.table1". O(pattern · text) for any pattern.
bool matches_glob(std::string_view pattern, std::string_view text);
// Whether one of the patterns matches; true for no patterns.
bool matches_any(std::span<const std::string> patterns, std::string_view text);
// Throws usage_error for a pattern that matches none of the names, which would silently choose nothing.
// `listing` is the command that prints the names.
void demand_matches(std::span<const std::string> patterns, std::span<const std::string_view> names,
                    std::string_view kind, std::string_view listing);

}  // namespace terrabench
