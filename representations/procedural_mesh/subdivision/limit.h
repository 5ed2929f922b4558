// Points of the limit surface at a mesh's vertices, when standard refinement follows for ever ("meshgrow" §3;
// Halstead, Kass and DeRose 1993; Biermann, Levin and Zorin 2000 for boundaries and creases):
//  - smooth, n faces: (n (n - 1) v + 2 Σ neighbours + 4 Σ face means) / (n (n + 5)), for faces of any
//  corners;
//  - boundary or a crease that stays sharp: (4 v + neighbours along it) / 6;
//  - a corner that stays sharp: v.
// A vertex whose edges lose their sharpness later, and a dart, have no such mask: there the vertex and its
// ring are refined until they stop moving, which takes O(valence) per step and reaches the limit to rounding.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// One limit point per vertex. T: glm::vec3, glm::dvec3 or double. The topology is complete. O(corners).
template <class T>
void limit_points(const Topology&, std::span<const T> in, std::span<T> out);

}  // namespace terrabench::subdivision
