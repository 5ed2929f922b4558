// Ids of figures that are drawn once per ground.
#pragma once

#include <string>
#include <string_view>

namespace terrabench::figures {

// What follows the id: nothing for the main ground, whose figures are the paper's; ".name" for others. Of a
// path only the last part counts, with '_' for what file names should not hold.
std::string ground_suffix(std::string_view ground, std::string_view main_ground);

}  // namespace terrabench::figures
