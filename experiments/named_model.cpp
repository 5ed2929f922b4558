#include "experiments/named_model.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "terrain/error.h"
#include "terrain/events/event_file.h"
#include "terrain/files.h"
#include "terrain/source.h"

namespace terrabench {
namespace {

bool is_built_in(const std::string& name) {
  const std::vector<std::string> names = growing::model_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_name(const std::string& name) {
  if (name.starts_with(kDrawingPrefix)) return;
  try {
    terrain_file(name);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kUsage) throw;
    const std::vector<std::string> models = growing::model_names();
    std::vector<std::string_view> known(models.begin(), models.end());
    for (const TerrainType& type : terrains()) known.push_back(type.name);
    const Error unknown = unknown_name("terrain or model", name, known);
    throw Error(unknown.code(), unknown.what(), "",
                unknown.advice() + "; the path of a DEM or model file works too");
  }
}

}  // namespace

bool names_model(const std::string& name) {
  if (is_built_in(name)) return true;
  check_name(name);
  std::error_code error;
  if (!name.ends_with(".toml") || !std::filesystem::is_regular_file(name, error)) return false;
  // Event files may be longer than models. A model that is too long is one all the same: open_model_text()
  // says so.
  const std::uintmax_t bytes = std::filesystem::file_size(name, error);
  return !error && bytes <= events::kMostBytes && is_model_text(read_file(name));
}

std::string open_model_text(const std::string& name) {
  if (is_built_in(name)) return std::string(growing::model_text(name));
  return read_file(name, growing::kMostModelBytes);
}

}  // namespace terrabench
