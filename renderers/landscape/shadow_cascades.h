// The parts of the scene that shadow maps cover: boxes along the sun's direction around spheres ahead of the
// eye, each larger than the one before.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "renderers/landscape/scene_block.h"
#include "terrain/view.h"

namespace terrabench {

struct Cascade {
  glm::mat4 world_to_clip{1};  // z in 0…1, 0 nearest the sun
  float texel = 0;             // metres
};

// `reach`: how far from the eye shadows are drawn, metres; `side`: texels along a map's side. The boxes hold
// all ground within `ground` that can cast a shadow into them. Moves by whole texels with the eye, so that
// shadows do not flicker.
std::array<Cascade, kCascades> shadow_cascades(const View&, glm::vec3 sun, const Bounds& ground, float reach,
                                               int side);

}  // namespace terrabench
