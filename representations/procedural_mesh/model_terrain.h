// Models of "meshgrow" as terrain sources: any representation may be built from their solid, and
// procedural_mesh from their text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "terrain/source.h"

namespace terrabench {

// Where a model stands on its ground.
struct ModelPlace {
  float x = 0, z = 0;  // of the model's own origin, metres on the ground
  float scale = 1;     // of the model
};

// Whether a text can only be a model, not a script of events: it has a base.
bool is_model_text(std::string_view text);

// `name` names the text in errors and results. Expands the model: seconds for millions of faces. Throws
// bad_input for what is no model, and for a model that has no volume.
TerrainSource model_source(std::string_view text, const std::string& name);

// The model on a ground of heights, which becomes a displaced plane: united where they overlap. Its foot,
// what lies within a fiftieth of its height above its lowest vertex, touches the ground everywhere or lies
// under it. Throws usage_error for ground that is a solid, and for a place off the ground.
TerrainSource model_on_ground(std::string_view text, const std::string& name, const TerrainSource& ground,
                              std::optional<ModelPlace>);

}  // namespace terrabench
