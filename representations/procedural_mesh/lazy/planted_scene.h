// Many instances of models on ground, each with its own seed: a scene that is described by a few bytes per
// instance and expanded only where a view needs it ("meshgrow" §6 and §8).
//
// What every instance would have at each level of detail is known beforehand, from its growing steps alone
// (detail.h); so are a box around it and the number of faces in total. A view chooses the level of every
// instance before anything is expanded: the choice depends on the view and the scene alone.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "representations/procedural_mesh/lazy/detail.h"
#include "terrain/memory.h"
#include "terrain/progress.h"
#include "terrain/view.h"

namespace terrabench::growing {

struct Instance {
  glm::vec3 position{0};  // metres, of the model's origin
  float turn = 0;         // radians, around the vertical
  float scale = 1;        // above 0
  std::uint32_t model = 0;
  std::uint64_t seed = 0;
};
glm::mat4 to_world(const Instance&);

// Instances in a square, one per cell of a grid, at a random place in it.
struct Planting {
  std::uint64_t count = 0;
  float side = 100;              // metres, of the square from (0, 0)
  std::vector<double> shares{};  // per model, how often it occurs; at least 0, not all 0
  float least_scale = 0.8F, most_scale = 1.2F;
  std::uint64_t seed = 1;
  std::uint64_t most_bytes = std::uint64_t{1} << 28;  // that the scene may take
};
// `height` gives the ground's height at x, z; it is called from many threads. The same for every number of
// threads. Throws bad_input for values out of range, and before it allocates for a count over the budget.
std::vector<Instance> scatter(const Planting&, const std::function<float(float x, float z)>& height);

// When a level is fine enough.
struct DetailSettings {
  // A level has at least one face per so many pixels of the disc that the instance's bounding sphere covers:
  // the square of `spacing`. 0: always the finest level.
  double spacing = 1.5;
  double out_of_view = 4;  // factor of `spacing` outside the frustum, which rays may still reach
};

class PlantedScene {
 public:
  // Throws what expansion throws; bad_input for an instance of no model, with values that are not finite, or
  // a scale that is not positive; for levels whose numbers of faces do not fall. In parallel, the same for
  // every number of threads. O(faces of the grown meshes).
  PlantedScene(std::vector<DetailModel>, std::vector<Instance>, Progress* = nullptr);

  std::span<const DetailModel> models() const { return models_; }
  std::span<const Instance> instances() const { return instances_; }
  std::size_t levels(std::size_t instance) const { return models_[instances_[instance].model].levels.size(); }
  // Of an instance's expansion at a level; exact.
  std::uint64_t faces(std::size_t instance, std::size_t level) const {
    return faces_[first_level_[instance] + level];
  }
  std::uint64_t total_faces() const { return total_; }  // all instances at their finest level
  const Bounds& box(std::size_t instance) const { return boxes_[instance]; }  // in the world, of all levels
  const Bounds& local_box(std::size_t instance) const { return local_boxes_[instance]; }

  GrownMesh mesh(std::size_t instance, std::size_t level) const;  // expands it

  // The level of every instance. O(instances · levels).
  std::vector<std::uint8_t> choose_levels(const View&, const DetailSettings&) const;

  Memory memory() const;  // of the instances, without the models

 private:
  std::vector<DetailModel> models_;
  std::vector<Instance> instances_;
  std::vector<Bounds> boxes_, local_boxes_;
  std::vector<std::uint32_t> first_level_;  // per instance, in faces_
  std::vector<std::uint32_t> faces_;
  std::uint64_t total_ = 0;
};

// The coarsest level with at least one face per spacing² pixels of a disc of `disc` pixels; the finest if
// none has. `faces` falls from level to level.
std::size_t coarsest_level(std::span<const std::uint32_t> faces, double disc, double spacing);

// Pixels of the disc that a sphere covers in the middle of a picture; infinite from inside the sphere.
double disc_pixels(const View&, const glm::vec3& middle, float radius);

}  // namespace terrabench::growing
