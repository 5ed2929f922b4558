// A forest of the models of "meshgrow" on a fractal plane, expanded lazily for the ray tracer.
#pragma once

#include <atomic>
#include <memory>

#include "experiments/meshgrow/models.h"
#include "renderers/raytrace/coherent/coherent_picture.h"
#include "representations/procedural_mesh/lazy/part_cache.h"
#include "representations/procedural_mesh/lazy/planted_scene.h"

namespace terrabench::meshgrow {

struct ForestSettings {
  std::uint64_t instances = 1000;
  double area = 60;        // square metres per instance
  bool all_leaves = true;  // false: only levels with fewer leaves, for a forest that fits into memory
  std::uint64_t seed = 1;
};

// The ground, and what stands on it. Immutable once planted.
class Forest {
 public:
  explicit Forest(const ForestSettings&, Progress* = nullptr);

  const growing::PlantedScene& plants() const { return plants_; }
  const RayPart& ground() const { return *ground_; }
  const Bounds& ground_box() const { return ground_box_; }
  float side() const { return side_; }  // metres, of the square from (0, 0) in which instances stand
  float height(float x, float z) const;

  RayMaterial material(const SurfacePoint&) const;

 private:
  float side_;
  std::unique_ptr<RayPart> ground_;
  Bounds ground_box_;
  growing::PlantedScene plants_;
};

// What was expanded for a picture.
struct Expanded {
  std::uint64_t parts = 0, faces = 0;  // different instances, at their levels
  std::uint64_t again = 0;             // faces expanded again after they were dropped
  std::uint64_t outside = 0;           // parts that left the box foreseen for them
  growing::CacheCounts cache;
};

// The forest as parts for one view; parts are numbered as the instances, then the ground.
class LazyForest {
 public:
  // `levels`: of each instance. Parts in memory never take more than `cache_bytes`, Embree's bytes included.
  LazyForest(const Forest&, std::vector<std::uint8_t> levels, std::size_t cache_bytes);

  const PartScene& parts() const { return parts_; }
  Expanded expanded() const;
  std::uint64_t faces_chosen() const;  // if every instance were expanded at its level
  Memory memory() const;               // on the heap: parts held and tables, without Embree's bytes
  std::uint64_t embree_bytes() const;

 private:
  std::unique_ptr<RayPart> make(std::uint32_t instance);
  void open(std::uint32_t part, const std::function<void(const RayPart&)>& use);

  const Forest& forest_;
  std::vector<std::uint8_t> levels_;
  growing::PartCache<RayPart> cache_;
  PartScene parts_;
  std::vector<std::atomic<std::uint8_t>> seen_;  // per instance, whether it was expanded
  std::atomic<std::uint64_t> distinct_{0}, faces_{0}, again_{0}, outside_{0};
};

}  // namespace terrabench::meshgrow
