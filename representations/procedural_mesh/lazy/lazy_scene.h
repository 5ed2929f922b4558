// The lazy loop of "meshgrow" (§6, §8): an instance of a planted scene is expanded when it is opened, at the
// level chosen for it, made into a part, and kept in a cache of bounded bytes.
//
// Part has bytes() and memory().
#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>

#include "representations/procedural_mesh/lazy/part_cache.h"
#include "representations/procedural_mesh/lazy/planted_scene.h"

namespace terrabench::growing {

// What was expanded so far.
struct Expanded {
  std::uint64_t parts = 0, faces = 0;  // different instances, at their levels
  std::uint64_t again = 0;             // faces expanded again after they were dropped
  std::uint64_t outside = 0;           // parts that left the box estimated for them
  CacheCounts cache;
};

template <class Part>
class LazyScene {
 public:
  using Make = std::function<std::unique_ptr<Part>(const FaceMesh&)>;

  // `levels`: of each instance. Parts in memory never take more than `cache_bytes`. The scene must outlive
  // this.
  LazyScene(const PlantedScene& scene, std::vector<std::uint8_t> levels, std::size_t cache_bytes, Make make)
      : scene_(scene),
        levels_(std::move(levels)),
        make_(std::move(make)),
        cache_(cache_bytes),
        seen_(levels_.size()) {}

  // Calls use() with the part of an instance, expanded unless the cache holds it. Thread-safe; use() may not
  // open another. Throws what the expansion and PartCache::with() throw.
  template <class Use>
  void open(std::uint32_t instance, const Use& use) {
    cache_.with(
        instance, [&] { return expand_isolated(instance); }, use);
  }

  Expanded expanded() const { return {distinct_, faces_, again_, outside_, cache_.counts()}; }
  std::uint64_t faces_chosen() const {  // if every instance were expanded at its level
    std::uint64_t faces = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i) faces += scene_.faces(i, levels_[i]);
    return faces;
  }
  Memory memory() const {
    Memory memory = payload_memory(levels_);
    memory.index += heap_bytes(seen_.data());
    cache_.each([&](const Part& part) { memory += part.memory(); });
    return memory;
  }

 private:
  // A thread that waits for the end of a parallel loop in the expansion must not begin another task, which
  // may wait for this very part; and when the caller is cancelled, the loops in here must not end half-way.
  std::unique_ptr<Part> expand_isolated(std::uint32_t instance) {
    std::unique_ptr<Part> part;
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::task_group group(own);
    tbb::this_task_arena::isolate([&] { group.run_and_wait([&] { part = expand(instance); }); });
    return part;
  }

  std::unique_ptr<Part> expand(std::uint32_t instance) {
    const FaceMesh faces = scene_.mesh(instance, levels_[instance]).mesh;
    if (beyond(box_of(faces.positions), scene_.local_box(instance)) > 0) ++outside_;
    const bool first = seen_[instance].exchange(1) == 0;
    distinct_ += first ? 1 : 0;
    (first ? faces_ : again_) += faces.faces();
    return make_(faces);
  }

  const PlantedScene& scene_;
  std::vector<std::uint8_t> levels_;
  Make make_;
  PartCache<Part> cache_;
  std::vector<std::atomic<std::uint8_t>> seen_;  // per instance, whether it was expanded
  std::atomic<std::uint64_t> distinct_{0}, faces_{0}, again_{0}, outside_{0};
};

}  // namespace terrabench::growing
