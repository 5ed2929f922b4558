// Ids of figures that are drawn once per ground.
#pragma once

#include <string>
#include <string_view>

namespace terrabench::figures {

// The end of a figure's id: empty for the main ground, which stands for the paper's own; ".name" for others.
// Of a path the last part is the name, with '_' in place of characters other than letters, digits and '-'.
std::string ground_suffix(std::string_view ground, std::string_view main_ground);

}  // namespace terrabench::figures
