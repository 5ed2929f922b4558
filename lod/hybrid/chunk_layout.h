// Where the chunks of a near surface lie over the samples of the far heights. The two meet at vertices only
// if the corners of all chunks lie over samples.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "terrain/heightfield.h"
#include "terrain/mesh_chunks.h"

namespace terrabench::hybrid {

struct ChunkLayout {
  glm::ivec2 first{0};   // sample at the low corner of chunk (0, 0)
  int side = 1;          // of a chunk, samples
  glm::ivec2 chunks{0};  // along x and z
  glm::ivec2 last{0};    // sample at the high corner of all chunks, whose last ones may be narrower

  glm::ivec2 low(glm::ivec2 chunk) const { return first + side * chunk; }
  glm::ivec2 high(glm::ivec2 chunk) const { return glm::min(low(chunk) + side, last); }
};

// The chunks that lie wholly within the surface's bounds and on the ground. Throws usage_error, with the
// numbers that do not fit, when corners of chunks do not lie over samples, or no chunk lies on the ground.
ChunkLayout layout_of(const MeshChunks&, const Heightfield&);

}  // namespace terrabench::hybrid
