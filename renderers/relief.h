// Shaded relief: a lit mesh, coloured by height, as papers and atlases show terrain. Level ground in the sun
// has the ramp's own colour (ramp.h), so that a legend can be read against it.
#pragma once

#include <glm/vec3.hpp>

#include "renderers/context.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench {

struct ReliefStyle {
  float lowest = 0, highest = 1;      // metres at the two ends of the colour ramp
  glm::vec3 sun{-0.5F, 0.7F, -0.5F};  // towards the light: from the north-west, the cartographers' convention
  Rgb background{255, 255, 255};
  bool wireframe = false;  // draws the triangles' edges over the relief
  // How much steeper the light takes slopes to be than they are; shape and outline stay true. 0 chooses by
  // the mesh: 1 for steep ground, more for gentle, whose relief would not show.
  float shading_exaggeration = 0;
};

// Draws the mesh with 4x multisampling into view.width × view.height, which the context's picture takes as
// its size; the context is current afterwards. The depth range is the mesh's, not the view's. A mesh without
// normals shows flat facets, one without triangles the background; the backs of triangles are grey. The same
// mesh and view give the same bytes whatever the number of threads. O(triangles + pixels).
Image render_relief(GlContext&, const TriangleMesh&, const View&, const ReliefStyle&);

}  // namespace terrabench
