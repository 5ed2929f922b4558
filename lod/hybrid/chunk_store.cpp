#include "lod/hybrid/chunk_store.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cassert>
#include <glm/vector_relational.hpp>
#include <utility>

#include "terrain/memory.h"

namespace terrabench::hybrid {

// Threads beside the caller's, behind all other work.
struct ChunkStore::Background {
  tbb::task_arena arena{std::max(tbb::this_task_arena::max_concurrency() - 1, 1), 0,
                        tbb::task_arena::priority::low};
  tbb::task_group tasks;
};

ChunkStore::ChunkStore(const MeshChunks& surface, int across)
    : surface_(surface),
      across_(across),
      chunks_(static_cast<std::size_t>(across) * static_cast<std::size_t>(across)),
      background_(std::make_unique<Background>()) {}

ChunkStore::~ChunkStore() {
  for (Chunk& chunk : chunks_) {  // tasks find nothing to do
    auto queued = Chunk::State::kQueued;
    chunk.state.compare_exchange_strong(queued, Chunk::State::kEmpty);
  }
  finish();
}

Chunk& ChunkStore::slot(glm::ivec2 at) {
  const auto wrap = [&](int k) { return static_cast<std::size_t>((k % across_ + across_) % across_); };
  return chunks_[wrap(at.y) * static_cast<std::size_t>(across_) + wrap(at.x)];
}

bool ChunkStore::holds(glm::ivec2 at) const {
  const Chunk& chunk = slot(at);
  return chunk.at == at && chunk.state.load() != Chunk::State::kEmpty;
}

void ChunkStore::queue(glm::ivec2 at) {
  assert(!holds(at));
  Chunk& chunk = slot(at);
  auto queued = Chunk::State::kQueued;
  if (!chunk.state.compare_exchange_strong(queued, Chunk::State::kEmpty)) {
    chunk.state.wait(Chunk::State::kBuilding);
  }
  chunk.at = at;
  chunk.id = 0;
  chunk.failure = nullptr;
  chunk.state.store(Chunk::State::kQueued);
  background_->arena.enqueue(background_->tasks.defer([this, &chunk] { build_if_queued(chunk); }));
}

// A task may find another chunk queued in its slot than when it was made; that one's own task then finds
// nothing to do.
void ChunkStore::build_if_queued(Chunk& chunk) {
  auto queued = Chunk::State::kQueued;
  if (!chunk.state.compare_exchange_strong(queued, Chunk::State::kBuilding)) return;
  build(chunk);
  chunk.state.store(Chunk::State::kBuilt);
  chunk.state.notify_all();
}

void ChunkStore::build(Chunk& chunk) {
  try {
    chunk.version = surface_.version(chunk.at);
    chunk.mesh = surface_.chunk(chunk.at, 0);
    if (chunk.mesh.normals.size() != chunk.mesh.positions.size()) compute_normals(chunk.mesh);
  } catch (...) {
    chunk.failure = std::current_exception();
  }
  built_.fetch_add(1, std::memory_order_relaxed);
}

Chunk& ChunkStore::get(glm::ivec2 at) {
  assert(holds(at));
  Chunk& chunk = slot(at);
  build_if_queued(chunk);
  chunk.state.wait(Chunk::State::kBuilding);
  if (chunk.failure == nullptr && chunk.version != surface_.version(at)) {
    build(chunk);
    chunk.id = 0;
  }
  if (chunk.failure != nullptr) {
    chunk.state.store(Chunk::State::kEmpty);
    std::rethrow_exception(std::exchange(chunk.failure, nullptr));
  }
  return chunk;
}

void ChunkStore::forget_joins(const ChunkLayout& layout, glm::ivec2 low, glm::ivec2 high) {
  for (Chunk& chunk : chunks_) {
    const bool touches = glm::all(glm::lessThanEqual(layout.low(chunk.at), high)) &&
                         glm::all(glm::greaterThanEqual(layout.high(chunk.at), low));
    if (touches) chunk.id = 0;
  }
}

void ChunkStore::finish() const {
  background_->arena.execute([&] { background_->tasks.wait(); });
}

Memory ChunkStore::memory() const {
  Memory memory;
  memory.index += heap_bytes(chunks_.data()) + heap_bytes(background_.get());
  for (const Chunk& chunk : chunks_) {
    for (const TriangleMesh* mesh : {&chunk.mesh, &chunk.joined}) {
      memory += payload_memory(mesh->positions, mesh->normals, mesh->indices);
    }
  }
  return memory;
}

}  // namespace terrabench::hybrid
