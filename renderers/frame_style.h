// Uniforms of the programs that draw a level of detail's triangles with relief.frag, with or without
// wire.geom.
#pragma once

#include <glm/mat4x4.hpp>

#include "renderers/frame_renderer.h"
#include "renderers/gl.h"
#include "terrain/view.h"

namespace terrabench {

void set_matrix(const Program&, const glm::mat4& world_to_clip);
void set_style(const Program&, const View&, const FrameStyle&);

}  // namespace terrabench
