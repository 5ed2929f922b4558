// The chunks around the eye: built ahead of it on background threads, kept until others take their place.
//
// A chunk's state:
//   empty     nothing, or what an earlier chunk left
//   queued    waits for a background thread, or for a caller of get(), who builds it then
//   building  one thread is building it
//   built     its mesh can be read; or its failure, which get() throws
//
// What get() returns does not depend on which thread built it, nor on when.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <vector>

#include "lod/hybrid/chunk_layout.h"
#include "lod/hybrid/rim.h"
#include "terrain/memory.h"
#include "terrain/mesh_chunks.h"

namespace terrabench::hybrid {

// A chunk as built and as drawn. The drawn part belongs to the caller of get().
struct Chunk {
  enum class State : std::uint8_t { kEmpty, kQueued, kBuilding, kBuilt };
  std::atomic<State> state = State::kEmpty;
  glm::ivec2 at{-1};
  std::uint64_t version = 0;  // of the near surface when building began
  TriangleMesh mesh;
  std::exception_ptr failure;

  std::uint64_t id = 0;  // of the drawn mesh; 0: none yet
  RimDistances rim;      // that it was joined to
  TriangleMesh joined;   // empty while the drawn mesh is `mesh` itself
  bool is_joined = false;
  Bounds box;                        // of the drawn mesh
  std::uint64_t last_listed_in = 0;  // number of a frame
};

class ChunkStore {
 public:
  // Holds a square of `across` × `across` chunks, wherever it lies. The surface must outlive it.
  ChunkStore(const MeshChunks& surface, int across);
  ~ChunkStore();
  ChunkStore(const ChunkStore&) = delete;
  ChunkStore& operator=(const ChunkStore&) = delete;

  // Whether the chunk is queued, being built or built.
  bool holds(glm::ivec2 at) const;
  // Queues a chunk that is not held. Takes the place of the chunk `across` chunks away, if that is held.
  void queue(glm::ivec2 at);
  // The held chunk at the surface's present version: waits for it, or builds it if no thread has begun.
  // Valid until another takes its place. Throws what building it threw; the chunk is then empty.
  Chunk& get(glm::ivec2 at);

  // Makes the held chunks that touch samples low … high count as not yet joined. Call finish() before.
  void forget_joins(const ChunkLayout&, glm::ivec2 low, glm::ivec2 high);

  // Waits until no background thread reads the surface; queued chunks are built first.
  void finish() const;
  std::size_t built() const { return built_; }  // chunks in total, edited ones once per version
  Memory memory() const;                        // heap bytes, after finish()

 private:
  struct Background;
  Chunk& slot(glm::ivec2 at);
  const Chunk& slot(glm::ivec2 at) const { return const_cast<ChunkStore*>(this)->slot(at); }
  void build(Chunk&);
  void build_if_queued(Chunk&);

  const MeshChunks& surface_;
  int across_;
  std::vector<Chunk> chunks_;  // chunk (a, b) at (b mod across)·across + (a mod across)
  std::atomic<std::size_t> built_ = 0;
  std::unique_ptr<Background> background_;  // last: destroyed first, and waits
};

}  // namespace terrabench::hybrid
