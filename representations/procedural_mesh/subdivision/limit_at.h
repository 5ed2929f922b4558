// The limit surface at any point of a mesh, when standard refinement follows for ever ("meshgrow" §3, which
// names Stam 1998). As there, refinement around the point goes on until the point lies in a regular patch,
// where the limit is a bicubic B-spline. Stam jumps over these steps by eigenvectors; here they are taken, on
// the faces around the point alone, which also holds beside creases and boundaries.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// `face` is a quadrilateral; `at`, in [0, 1]², is (0, 0) at its first corner and (1, 0) at its second. The
// topology is complete, with one point per vertex. Exact to rounding. O(log(1 / distance)) refinements of the
// faces around one face, where `distance` is that to the next extraordinary vertex, crease or boundary; at
// most 50.
glm::dvec3 limit_at(const Topology&, std::span<const glm::dvec3> points, std::uint32_t face, glm::dvec2 at);

// The child of a quadrilateral in which a place lies (child k has the quadrilateral's corner k first) and the
// place in the child; and the other way round.
int child_at(glm::dvec2& at);
glm::dvec2 place_in_parent(int child, glm::dvec2 at);

}  // namespace terrabench::subdivision
