// Shaded relief: a lit mesh, coloured by height, as in papers and atlases. Level ground in the sun has
// exactly the ramp's colour (ramp.h), so that it can be compared with a legend.
#pragma once

#include <glm/vec3.hpp>

#include "renderers/context.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench {

struct ReliefStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light; by cartographers' convention from the north-west
  Rgb background{255, 255, 255};
  bool wireframe = false;          // draws the triangles' edges over the relief
  float shading_exaggeration = 0;  // as in SceneMesh
};

// render_scene() of one lit mesh. A mesh without normals has flat facets, one without triangles gives the
// background; backs of triangles are grey. O(triangles + pixels).
Image render_relief(GlContext&, const TriangleMesh&, const View&, const ReliefStyle&);

}  // namespace terrabench
