// The planes and lines of a scene, drawn over its meshes and hidden behind them.
#pragma once

#include <glm/mat4x4.hpp>

#include "renderers/scene.h"

namespace terrabench {

// Draws planes from back to front, for blending, then lines. Clips at the near plane. Depth testing must be
// on. O(corners + planes log planes).
void draw_overlay(const Scene&, const View&, const glm::mat4& world_to_clip);

}  // namespace terrabench
