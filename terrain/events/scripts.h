// Terrains of events that come with the program: the files terrain/events/scripts/*.toml.
#pragma once

#include <cstdint>
#include <string_view>

#include "terrain/source.h"

namespace terrabench::events {

// The text of the file of that name (without its ending). Throws unknown_name.
std::string_view script_text(std::string_view name);
// That terrain; its seed is the file's own.
TerrainSource open_named_script(std::string_view name);

}  // namespace terrabench::events
