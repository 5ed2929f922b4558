// The terrains of events that are built into the program: the files terrain/events/scripts/*.toml.
#pragma once

#include <cstdint>
#include <string_view>

#include "terrain/source.h"

namespace terrabench::events {

// The text of the file with that name, without its extension. Throws unknown_name.
std::string_view script_text(std::string_view name);
// That terrain, with the seed in the file.
TerrainSource open_named_script(std::string_view name);

}  // namespace terrabench::events
