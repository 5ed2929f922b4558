// Ids of figures that are drawn once per ground.
#pragma once

#include <string>
#include <string_view>

namespace terrabench::figures {

// The end of a figure's id: empty for the main ground, on which the paper's claim is measured; ".name" for
// others. The name of a path is its last component. Characters other than letters, digits and '-' become '_'.
std::string ground_suffix(std::string_view ground, std::string_view main_ground);

}  // namespace terrabench::figures
