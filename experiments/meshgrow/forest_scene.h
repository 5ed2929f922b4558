// A forest of the models of "meshgrow" on a fractal plane, expanded lazily for the ray tracer.
#pragma once

#include <memory>

#include "experiments/meshgrow/models.h"
#include "renderers/raytrace/coherent/coherent_picture.h"
#include "representations/procedural_mesh/lazy/lazy_scene.h"

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

// The forest as parts for one view; parts are numbered as the instances, then the ground.
class LazyForest {
 public:
  // `levels`: of each instance. Parts in memory never take more than `cache_bytes`, Embree's bytes included.
  LazyForest(const Forest&, std::vector<std::uint8_t> levels, std::size_t cache_bytes);

  const PartScene& parts() const { return parts_; }
  growing::Expanded expanded() const { return plants_.expanded(); }
  std::uint64_t faces_chosen() const { return plants_.faces_chosen(); }
  // On the heap: parts held and tables, without Embree's bytes.
  Memory memory() const;

 private:
  growing::LazyScene<RayPart> plants_;
  PartScene parts_;
};

}  // namespace terrabench::meshgrow
