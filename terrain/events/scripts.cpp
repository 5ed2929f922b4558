#include "terrain/events/scripts.h"

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/embedded.h"
#include "terrain/error.h"
#include "terrain/events/event_file.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_scripts();

namespace events {

std::string_view script_text(std::string_view name) {
  std::vector<std::string> known;
  for (const EmbeddedFile& file : embedded_scripts()) {
    known.push_back(std::filesystem::path(file.name).stem().string());
    if (known.back() == name) return file.text;
  }
  const std::vector<std::string_view> names(known.begin(), known.end());
  throw unknown_name("terrain of events", name, names);
}

TerrainSource open_named_script(std::string_view name) {
  TerrainSource source = open_script(script_text(name), std::string(name));
  source.name = name;
  return source;
}

}  // namespace events
}  // namespace terrabench
