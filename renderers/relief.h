// Shaded relief: a lit mesh, coloured by height, as papers and atlases show terrain.
#pragma once

#include "renderers/context.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench {

struct ReliefStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light: from the north-west, the cartographers' convention
  Rgb background{255, 255, 255};
  bool wireframe = false;
};

// Draws the mesh with 4x multisampling into view.width × view.height. The context must be current.
Image render_relief(GlContext&, const TriangleMesh&, const View&, const ReliefStyle&);

}  // namespace terrabench
