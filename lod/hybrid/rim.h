// The transition between the near surface and the far heights (hybrid paper, §3.5): around the edge of the
// near surface its points are moved towards the far heights, by a share that grows to 1 at the rim.
//
// The paper says no more. Here the share is 1 - smoothstep(d / band), where d is the distance in plan to the
// rim: a vertex moves vertically, and the order of surfaces over each other stays. At the rim all of them
// have the far heights, so that overhangs and caves taper to nothing. A vertex on the rim moves along it to
// the nearest sample, so that the edges there are those of the far triangles to the bit and without
// T-junctions; triangles that this leaves without area are dropped, and sides that span several samples are
// divided.
#pragma once

#include <glm/vec2.hpp>

#include "terrain/heightfield.h"
#include "terrain/mesh.h"

namespace terrabench::hybrid {

// A rectangle of samples: the outline of one chunk, or of the near surface.
struct Outline {
  glm::ivec2 low{0}, high{0};
  bool operator==(const Outline&) const = default;
};

struct Rim {
  Outline outline;
  int band = 1;  // samples, at least 1
};

// The distances of a chunk from the four sides of the rim, each at most the band: what its joined mesh
// depends on. Zero on the sides on the rim.
struct RimDistances {
  glm::ivec2 low{0}, high{0};
  bool operator==(const RimDistances&) const = default;
};
RimDistances distances(const Outline& chunk, const Rim&);

// The chunk's mesh, joined to the heights. Its lattice may be finer or coarser than the heights'. O(vertices
// + triangles). Throws bad_input when the surface is not closed along the rim: over each point there it must
// rise to the air once more than it returns into the ground.
TriangleMesh join(const TriangleMesh&, const Outline& chunk, const Rim&, const Heightfield&);

}  // namespace terrabench::hybrid
