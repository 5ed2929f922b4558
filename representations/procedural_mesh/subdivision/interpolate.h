// Values at the vertices of a refined mesh from those of the coarser one, in flat arrays: positions, texture
// coordinates or any other attribute. Standard placement is that of Catmull and Clark (1978); linear
// placement keeps the vertices and takes means on edges and faces.
//
// O(C) on all threads; every value is summed in a fixed order, so the number of threads changes nothing.
// `in` has one value per vertex of the coarser mesh, `out` one per vertex of the finer one; they do not
// overlap. T: float, double, glm::vec2, glm::vec3, glm::dvec2 or glm::dvec3.
#pragma once

#include "representations/procedural_mesh/subdivision/refine.h"

namespace terrabench::subdivision {

// Uses only the corners of the topology, and its stencils.
template <class T>
void place_standard(const Topology&, const Stencils&, std::span<const T> in, std::span<T> out);
template <class T>
void place_linear(const Topology&, const Stencils&, std::span<const T> in, std::span<T> out);

}  // namespace terrabench::subdivision
