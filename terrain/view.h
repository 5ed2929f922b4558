// A camera: the view that level-of-detail methods adapt to and renderers draw.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "terrain/solid.h"

namespace terrabench {

struct View {
  glm::vec3 eye{0}, target{0, 0, -1}, up{0, 1, 0};  // metres, y up
  float vertical_fov = 0.8F;                        // radians, in (0, π)
  int width = 800, height = 600;                    // pixels
  float near = 0.5F, far = 10000.0F;                // metres
};

// Throws usage_error, naming the member, for a view that cannot be drawn.
void check_view(const View&);
glm::mat4 world_to_clip(const View&);  // OpenGL clip space, z in [-1, 1]

// A view of the whole box that fills the picture, from the south-east and above, as papers show relief; or
// from the direction `from`, which must not be vertical.
View overview(const Bounds&, int width, int height, glm::vec3 from = {0.55F, 0.75F, 1.0F});

}  // namespace terrabench
