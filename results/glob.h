// Names chosen by pattern: * stands for any characters, ? for one.
#pragma once

#include <string_view>

namespace terrabench {

// "hybrid.*" against "hybrid.table1". O(pattern · text), whatever the pattern.
bool matches_glob(std::string_view pattern, std::string_view text);

}  // namespace terrabench
