// How "ght" draws a tree: its ground planes, the surface with the node of each triangle, and the views of
// these, whole or cut open, as wires, solid or textured.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "experiments/figures/views.h"
#include "renderers/scene.h"
#include "representations/ght/ght.h"
#include "terrain/parameters.h"

namespace terrabench::ght {

struct TreeSurface {
  TriangleMesh mesh;          // with normals; sharp where two nodes meet
  std::vector<NodeId> nodes;  // one per triangle: the latest of its corners' nodes
};
// O(surface)
TreeSurface tree_surface(const Model&);

// Corners of the ground plane of a node, in order: the convex hull of its cells that are not void, or of all
// its cells if those lie in one row. O(cells of the node)
std::vector<glm::vec3> plane_outline(const Tree&, NodeId);

// The ground planes as planes_view() draws them: the root's grey, then those of the other nodes in colour.
// O(cells)
std::vector<ScenePlane> ground_planes(const Tree&);
Image planes_view(GlContext&, const Ght&, const figures::Look&);
// The triangles of the root grey, those of other nodes blue.
Image wires_view(GlContext&, const Ght&, const figures::Look&);
Image wires_view(GlContext&, const Ght&, const View&);
// Lit and coloured by height, as a block of ground.
Image solid_view(GlContext&, const Ght&, const figures::Look&);

// The surface with textures by height and slope, lit and shadowed, under a sky. `style` holds
// landscape_parameters() (renderers/landscape/style.h).
Image textured_view(GlContext&, const Ght&, const View&, const Parameters& style);
// As a block of ground on white, with yellow particles above it.
Image textured_block(GlContext&, const Ght&, const View&, const Parameters& style,
                     const TriangleMesh& particles);

// The upright sides of the tree as a block of ground.
TriangleMesh sides_of(const Ght&);

// Cuts that leave the ground from sample `low` to sample `high`.
std::vector<figures::CutPlane> around(const Ght&, glm::ivec2 low, glm::ivec2 high);

}  // namespace terrabench::ght
