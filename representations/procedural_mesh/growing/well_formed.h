// Whether the meshes that a model writes down are well formed ("meshgrow" §4): then growing adds no T-vertex,
// no hole and no non-manifold edge.
#pragma once

#include "representations/procedural_mesh/growing/rules.h"
#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::growing {

// Throws bad_input at `where` if a face has fewer than 3 corners, one of them twice, no area, or a vertex
// that does not exist; if an edge has more than two faces, or two in the same direction; if a vertex joins
// two fans of faces, or has no face. O(corners log valence).
subdivision::Topology check_base(const FaceMesh&, const std::string& where);

// The same, but for areas, of a template that is a mesh, together with its base: every edge of the base is
// used once, in its direction; every other edge by two faces, and it does not join two corners of the base.
subdivision::Topology check_template(const Template&, const std::string& where);

}  // namespace terrabench::growing
