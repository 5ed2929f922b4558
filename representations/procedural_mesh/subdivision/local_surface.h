// What a placement rule may know about the surface at a vertex ("meshgrow" §3, "vertex placement"): the local
// normal vector, "the average normal of all faces meeting in the vertex", the local scale factor, "the
// average diagonal length of all faces meeting at the vertex", and two tangents, which make a local frame
// (figure 3).
//
// Readings of the paper: the average is that of unit normals. The diagonal length of a quadrilateral is the
// mean of its two; of a triangle, which has none, the mean edge length; of a polygon of n corners, the mean
// distance between corners that are n/2 steps apart. The first tangent points as u of the texture coordinates
// grows, projected onto the tangent plane; where that gives no direction, as an axis of the world.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "representations/procedural_mesh/subdivision/topology.h"

namespace terrabench::subdivision {

// One entry per vertex. Normals and tangents have unit length and tangents are at right angles to normals;
// the normal is +y and the scale 0 where no face gives them. The second tangent is cross(normal, tangent).
struct LocalSurface {
  Array<glm::vec3> normals;
  Array<float> scales;        // metres
  Array<glm::vec3> tangents;  // empty unless asked for
};

// `texture` may be empty. The topology needs `uses`. O(corners) on all threads.
LocalSurface local_surface(const Topology&, std::span<const glm::vec3> positions,
                           std::span<const glm::vec2> texture, bool with_tangents);

}  // namespace terrabench::subdivision
