// The values of --set.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "terrain/parameters.h"

namespace terrabench {

// Splits texts such as "n=16,scale=2" into single assignments "n=16" and "scale=2". A comma ends a value
// where "name=" of one of the specs follows it, so that the value of a text parameter may contain other
// commas: "options=roam.a=1,clipmap.b=2". After a number, true or false, it ends the value before any
// "name=".
std::vector<std::string> split_assignments(std::span<const std::string> texts,
                                           std::span<const ParameterSpec> specs);

}  // namespace terrabench
