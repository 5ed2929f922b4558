// Ground as triangle meshes in chunks: how a level-of-detail method obtains the near surface of a structure
// that it does not know, such as the implicit surface of the hybrid paper (§3.5).
//
// Chunks are squares in plan, numbered along x and z from bounds().low; each holds the surface over its
// square at all heights. Lattice point (i, j) lies at bounds().low + (i·cell, j·cell) in plan, and chunk a
// begins at lattice point a·cells(). Triangles never cross a chunk's border: the vertices on a border are
// bit-identical in the two chunks that share it, if both have the same detail.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "terrain/mesh.h"

namespace terrabench {

class MeshChunks {
 public:
  virtual ~MeshChunks() = default;

  virtual Bounds bounds() const = 0;      // metres; the chunks cover it in plan
  virtual float cell() const = 0;         // metres between lattice points at detail 0
  virtual int cells() const = 0;          // along a chunk's side at detail 0, a power of two
  virtual glm::ivec2 chunks() const = 0;  // along x and z

  // The surface over a chunk, with unit normals; empty where there is none. Cells are 2^detail times as large
  // as at detail 0, which must not exceed the chunk. Thread-safe against itself and version().
  virtual TriangleMesh chunk(glm::ivec2 at, int detail) const = 0;
  // Grows whenever an edit changes the chunk's surface.
  virtual std::uint64_t version(glm::ivec2 at) const = 0;
};

}  // namespace terrabench
