// One step of Catmull–Clark refinement: the connectivity of the finer mesh, the stencils of the standard
// placement, and values placed by them (Catmull and Clark 1978; "meshgrow" §3, figure 1).
//
// A mesh of V vertices, F faces, E edges and C corners becomes one of C quadrilaterals with V + F + E
// vertices: those of the vertices come first, then one per face, then one per edge. So a vertex keeps its
// index in all finer meshes. Corner c becomes quadrilateral c: (vertex of c, its edge, its face, the edge
// before it); the children of a face lie one after the other.
#pragma once

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// How much of the finer connectivity to build.
enum class Detail : std::uint8_t {
  kCorners,  // enough for drawing
  kUses,     // and `first_use`, `uses`: enough for normals and scale factors
  kAll       // enough for the next refinement
};

// A child vertex is own · (its parent) + ring · (the sum of its ring). Which own and ring follows from the
// place alone, so the table holds indices and no weights:
//  - of a face with n corners: the mean of the corners, which the topology lists;
//  - of an edge: the mean of four, {ends, its two face points} when smooth, {ends, ends} when sharp;
//  - of a vertex with n faces: a ring of 2n (neighbour, face point, …), own (n - 2)/n, ring 1/n²; on a
//    crease: a ring of the crease's two neighbours, own 3/4, ring 1/8; a corner: no ring.
// Face points are indices from V, into the child's own vertices, so they must be placed first.
struct Stencils {
  Array<std::uint32_t> edges;       // 4 per edge
  Array<std::uint32_t> first_ring;  // V + 1 numbers
  Array<std::uint32_t> rings;
  std::uint32_t longest_ring = 0;
};

// The weights of a vertex whose ring has `count` entries.
struct RingWeights {
  double own, ring;
};
constexpr RingWeights ring_weights(std::uint32_t count) {
  if (count == 0) return {1, 0};
  if (count == 2) return {0.75, 0.125};
  const double n = count / 2;
  return {(n - 2) / n, 1 / (n * n)};
}

// Both need a topology with everything, and at most 2^30 corners in the finer mesh (checked by an
// assertion; Refinement throws). O(corners) on all threads, the same for any number of them.
Topology refine(const Topology&, Detail);
Stencils make_stencils(const Topology&);

std::uint32_t child_vertices(const Topology&);

// Values at the vertices of the finer mesh from those of the coarser one: positions, texture coordinates or
// any other attribute. Standard placement is that of Catmull and Clark; linear placement keeps the vertices
// and takes means on edges and faces. `in` has one value per vertex of the coarser mesh, `out` one per vertex
// of the finer one; they do not overlap. T: glm::vec2, glm::vec3 or glm::dvec3. O(C) on all threads; every
// value is summed in a fixed order, so the number of threads changes nothing. Of the topology, the corners
// are used.
template <class T>
void place_standard(const Topology&, const Stencils&, std::span<const T> in, std::span<T> out);
template <class T>
void place_linear(const Topology&, const Stencils&, std::span<const T> in, std::span<T> out);

}  // namespace terrabench::subdivision
