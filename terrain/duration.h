// Lengths of time for people.
#pragma once

#include <string>

namespace terrabench {

std::string duration(double seconds);  // "40 s", "12 min"

}  // namespace terrabench
