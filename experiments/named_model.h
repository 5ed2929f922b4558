// Models of mesh growing by the names that the command line takes: those that travel inside the program, and
// TOML files.
#pragma once

#include <string>

namespace terrabench {

// Whether it names a model: `terrabench list models`, or a .toml file that has a base mesh or rules. Other
// .toml files hold events. Throws unknown_name, with the nearest terrain or model, for what names neither a
// model nor a terrain nor a path.
bool names_model(const std::string& name_or_path);

// The text. Throws unknown_name or bad_input.
std::string open_model_text(const std::string& name_or_path);

}  // namespace terrabench
