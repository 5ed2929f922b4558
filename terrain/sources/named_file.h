// A terrain's name that holds a file and adjustments: FILE[,NAME=VALUE…], as in
// "coast.png,sea_level=0.4,peak=1500".
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "terrain/parameters.h"

namespace terrabench {

struct NamedFile {
  std::string file;  // may hold commas
  Parameters options;
};
// Throws usage_error for an unknown adjustment and for a value that its spec does not take.
NamedFile parse_named_file(std::string_view text, std::span<const ParameterSpec> specs);

}  // namespace terrabench
