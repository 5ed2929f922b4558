// A terrain's mesh as a ray-traced relief for print: coloured by height with relief.h's ramp, steep sides in
// rock grey, in a clear day's light on white paper.
#pragma once

#include "renderers/raytrace/ray_scene.h"

namespace terrabench {

// `lowest` and `highest`: metres at the ends of the colour ramp. The scene refers to the mesh.
RayScene relief_scene(const TriangleMesh&, float lowest, float highest);

}  // namespace terrabench
