// The planes and lines of a scene, drawn over its meshes and hidden behind them.
#pragma once

#include <glm/mat4x4.hpp>

#include "renderers/scene.h"

namespace terrabench {

// The farthest plane first, so that nearer ones are seen over it. What lies before the near plane is cut off.
// Depth testing is on. O(corners + planes log planes).
void draw_overlay(const Scene&, const View&, const glm::mat4& world_to_clip);

}  // namespace terrabench
