// OpenSubdiv's Catmull–Clark refinement of the same meshes, vertex by vertex beside ours: what the special
// case of the standard rule is compared with. Both constructions are followed level by level from the common
// base mesh, so that partners are known and no search by position can pair the wrong ones.
#pragma once

#include <opensubdiv/far/topologyRefiner.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "representations/procedural_mesh/face_mesh.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench::meshgrow {

struct PeerLevel {
  std::vector<glm::dvec3> points;   // theirs, in double precision
  std::vector<std::uint32_t> ours;  // theirs for each of our vertices
  // Our vertices, edges and corners of faces without a partner of their own, and numbers that differ.
  std::size_t mismatches = 0;
};

// The mesh with its creases and sharp vertices, refined so many times. `complete`: the last level has edges,
// too.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> opensubdiv_refiner(const FaceMesh&, int levels,
                                                                     subdivision::Boundary, bool complete);

// Levels 0 … refinement.levels(). `boundary` is the rule that the refinement was made with. Creases and sharp
// vertices are those of `base`. A level without partners is the last, with one mismatch. O(faces · valence).
std::vector<PeerLevel> opensubdiv_levels(const FaceMesh& base, const subdivision::Refinement& refinement,
                                         subdivision::Boundary boundary);

}  // namespace terrabench::meshgrow
