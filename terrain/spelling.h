// Typing slips: the name that was probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace terrabench {

// Whether the edit distance is so small that `name` is probably a slip of `known`. O(name · known).
bool is_slip(std::string_view name, std::string_view known);

// "; did you mean 'jacksboro'?" with the nearest name, or nothing if that is no slip.
std::string suggestion(std::string_view name, std::span<const std::string_view> known);

// "unknown key 'hieght'; did you mean 'height'?"
std::string unknown_key(std::string_view key, std::span<const std::string_view> known);

}  // namespace terrabench
