// Points of the limit surface, when standard refinement follows for ever: at a mesh's vertices, by masks
// ("meshgrow" §3; Halstead, Kass and DeRose 1993; Biermann, Levin and Zorin 2000 for boundaries and creases):
//  - smooth, n faces: (n (n - 1) v + 2 Σ neighbours + 4 Σ face means) / (n (n + 5)), for faces of any
//  corners;
//  - boundary or a crease that stays sharp: (4 v + neighbours along it) / 6;
//  - a corner that stays sharp: v.
// A vertex whose edges lose their sharpness later, and a dart, have no such mask: there the vertex and its
// ring are refined until they stop moving, which takes O(valence) per step and reaches the limit to rounding.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// One limit point per vertex, in double precision. The topology is complete. O(corners).
std::vector<glm::dvec3> limit_points(const Topology&, std::span<const glm::dvec3> points);

// The limit surface at any point, as Stam 1998, whom the paper names: refinement around the point goes on
// until the point lies in a regular patch, where the limit is a bicubic B-spline. Stam jumps over these steps
// by eigenvectors; here they are taken, on the faces around the point alone, which also holds beside creases
// and boundaries.
//
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
