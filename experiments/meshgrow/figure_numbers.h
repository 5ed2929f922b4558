// Numbers that can be read from the figures of "meshgrow", taken from the pictures and meshes that they show.
#pragma once

#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "experiments/figures/figure.h"
#include "experiments/meshgrow/fork.h"
#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench::meshgrow {

double degrees_between(const glm::dvec3&, const glm::dvec3&);

// Figure 1: what the step from `coarse`, with so many edges, must be by its definition. `linear` has the
// vertices that refinement adds, `fine` has them in their places.
void record_step(figures::Drawing&, const FaceMesh& coarse, std::size_t edges, const FaceMesh& linear,
                 const FaceMesh& fine);

// Figure 2: the root mean square length of the last step's displacements, in metres, of a base that was
// displaced by these rules; 0 without any.
double last_displacement(const FaceMesh& base, std::vector<subdivision::PlacementRule> rules,
                         const subdivision::RefinementOptions&, const FaceMesh& displaced);

// Of unit length: the mean of the unit normals of the quadrilaterals at a vertex.
glm::dvec3 mean_normal(const FaceMesh&, std::uint32_t vertex);
// From the first diagonal to the second, across a face of three or four corners. Of unit length.
glm::dvec3 face_normal(const FaceMesh&, std::uint32_t face);

// Figure 5: the longest edge per shortest edge of the face that is stretched most, and the number of faces
// that are stretched, among those with textures at most `reach` away from the middle, 0.5.
struct Stretch {
  double largest = 0, faces = 0;
};
Stretch stretch_within(const FaceMesh&, float reach);

// The angles between the faces at an edge, in degrees: over all edges with two faces.
struct Bends {
  double mean = 0, largest = 0;
};
Bends bends_of(const FaceMesh&);

// Parts of a pixel row without the white background, at least four pixels wide. `height`: 0 is the top row,
// 1 the lowest.
int parts_in_row(const Image&, double height);

// Figure 7: the frame of the face `base`, the first that grows, and the cube that grew on it by 0.9 m,
// against the face's own corners.
void record_frame(figures::Drawing&, const growing::GrownMesh& before, const growing::GrownMesh& after,
                  std::uint32_t base);

// Figure 9: how often u runs through its range, 0 to 1, around the foot of the trunk and around the end of
// each branch, and the averages at the vertices that branches share.
void record_coordinates(figures::Drawing&, const growing::Model&, const Fork&);

// The model as it would be without the displacements of a step; all faces and vertices are the same.
growing::GrownMesh without_displacements(growing::Model, std::string_view step);
// By how much each vertex lies over the other mesh, along its normals, in metres.
std::vector<double> heights_over(const FaceMesh&, const FaceMesh& other);
// Figures 10 and 13: how closely the heights that the step "ridges" gives a forking trunk follow the cosine
// of u that its model names. Pearson's correlation.
double ridges_along_u(const growing::Model&, const FaceMesh&);

}  // namespace terrabench::meshgrow
