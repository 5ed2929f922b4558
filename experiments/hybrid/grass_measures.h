// What figures 15 to 18 of "hybrid" show, as numbers that an unrelated picture does not have.
#pragma once

#include <span>
#include <vector>

#include "experiments/figures/figure.h"
#include "renderers/grass/grass.h"
#include "renderers/scene.h"
#include "terrain/heightfield.h"
#include "terrain/mesh.h"

namespace terrabench::hybrid {

// The largest excess over all guides, in degrees. A guide's excess is its largest angle with the normal of a
// face at its vertex, minus the largest angle between two of these normals: not above 0 for a guide along a
// mean of the normals.
double lean_out_of_faces(const TriangleMesh&, std::span<const SceneLine> guides);

// Strands on one triangle: their largest angle with the mean of its corners' normals, weighted by the
// barycentric coordinates of their roots, and the least mean of one of the three coordinates.
struct Interpolation {
  double off_the_normals = 0, least_coordinate = 0;  // degrees; 1/3 where strands are even
};

Interpolation interpolation_of(const TriangleMesh& triangle, const std::vector<GrassStrand>&);

// Records the angles and sizes of a strand's two planes, and where its grass appears: the pixels of a picture
// that differ from one of the bare ground, against those of the planes.
void record_billboards(figures::Drawing&, const std::vector<ScenePlane>&, const TriangleMesh& ground,
                       const View&, const Image& drawn, const Image& bare);

// Records the strands on cells of the ground that are steeper than 30°, and how many they would be by the
// cells' share of the area.
void record_steep_strands(figures::Drawing&, const Heightfield&, const TriangleMesh&,
                          std::span<const GrassStrand>);

}  // namespace terrabench::hybrid
