// Polygons as other programs want them: without the underside and the sides that close them, or with Z up.
#pragma once

#include "representations/procedural_mesh/face_mesh.h"
#include "terrain/solid.h"

namespace terrabench {

// Without the faces that lie whole in one side of these bounds, or in the bottom and look down, and without
// the vertices that only those use. Walls around samples without data stay. Creases are dropped. O(corners).
FaceMesh surface_only(const FaceMesh&, const Bounds&);

// From x east, y up, z south to x east, y north, z up.
void turn_z_up(FaceMesh&);

}  // namespace terrabench
