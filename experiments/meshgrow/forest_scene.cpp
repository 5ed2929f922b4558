#include "experiments/meshgrow/forest_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "representations/procedural_mesh/growing/expression.h"
#include "terrain/splitmix.h"

namespace terrabench::meshgrow {
namespace {

using growing::DetailLevel;

// Fewer leaves of fewer faces, so much larger that the plant covers as much of a picture, to a tenth.
// `levels`: of stems.
DetailLevel thinned(double levels, double leaves, double scale) {
  return {.leave_out = {"smooth"},
          .constants = {{"LeafDetail", 0},
                        {"Levels", levels},
                        {"Leaves", leaves},
                        {"LeafQuality", 1},
                        {"LeafScale", scale}}};
}

struct Plant {
  std::string_view model;
  double share;  // of the instances
  std::vector<DetailLevel> levels;
};
// Each level has a fraction of the faces of the one before.
const std::vector<Plant>& forest_plants() {
  static const std::vector<Plant> all{
      {"aspen",
       0.55,
       {{},
        {.fewer_subdivisions = 1},
        {.leave_out = {"smooth"}},
        thinned(3, 3, 0.45),
        thinned(2, 40, 0.68),
        thinned(2, 12, 1.15)}},
      {"tamarack",
       0.25,
       {{},
        {.fewer_subdivisions = 1},
        {.leave_out = {"smooth"}},
        thinned(3, 1, 0.93),
        thinned(2, 60, 0.95),
        thinned(2, 18, 1.37)}},
      {"oak",
       0.08,
       {{}, {.leave_out = {"smooth"}}, thinned(3, 1, 0.5), thinned(2, 60, 0.88), thinned(2, 30, 1.17)}},
      {"bush_tupelo",
       0.12,
       {{}, {.leave_out = {"smooth"}}, thinned(3, 3, 0.42), thinned(3, 1, 0.5), thinned(2, 10, 0.74)}},
  };
  return all;
}

std::vector<growing::DetailModel> detail_models(bool all_leaves) {
  std::vector<growing::DetailModel> models;
  for (const Plant& plant : forest_plants()) {
    std::vector<DetailLevel> levels = plant.levels;
    const auto is_thinned = [](const DetailLevel& level) { return !level.constants.empty(); };
    if (!all_leaves) levels.erase(levels.begin(), std::find_if(levels.begin(), levels.end(), is_thinned));
    models.push_back(
        growing::make_detail_model(growing::model_text(plant.model), std::string(plant.model), levels));
  }
  return models;
}

// The fractal plane, as wide as the forest and a margin around it, with flat hills.
std::unique_ptr<RayPart> fractal_ground(float side) {
  constexpr float kMargin = 0.15F, kRelief = 0.35F;  // shares of the side; of the model's heights
  const std::string name = "fractal_plane";
  const growing::Model model = growing::parse_model(growing::model_text(name), name);
  ModelMesh ground = triangles_of(growing::expand(model).mesh);
  const Bounds box = bounds_of(ground.mesh);
  const float scale = (1 + 2 * kMargin) * side / std::max(box.size().x, box.size().z);
  const glm::vec3 low = box.low;
  for (glm::vec3& p : ground.mesh.positions) {
    p = (p - glm::vec3(low.x, 0, low.z)) * glm::vec3(scale, scale * kRelief, scale) -
        glm::vec3(kMargin * side, 0, kMargin * side);
  }
  compute_normals(ground.mesh);
  return std::make_unique<RayPart>(std::move(ground.mesh), std::vector<glm::vec2>{},
                                   std::vector<std::uint32_t>{});
}

float side_of(const ForestSettings& settings) {
  return static_cast<float>(std::sqrt(static_cast<double>(settings.instances) * settings.area));
}

float noise(const glm::vec3& p) { return static_cast<float>(growing::gradient_noise(p.x, p.y, p.z)); }

RayMaterial soil(const SurfacePoint& at) {
  const glm::vec3& p = at.position;
  const float patches = std::clamp(0.5F + noise(0.21F * p) + 0.6F * noise(0.9F * p), 0.0F, 1.0F);
  const float grain = 1 + 0.3F * noise(7.0F * p) + 0.2F * noise(23.0F * p);
  const glm::vec3 color = glm::mix(glm::vec3(0.2F, 0.15F, 0.09F), glm::vec3(0.16F, 0.2F, 0.07F), patches);
  return {.albedo = glm::clamp(grain * color, 0.0F, 1.0F), .roughness = 1};
}

}  // namespace

Forest::Forest(const ForestSettings& settings, Progress* progress)
    : side_(side_of(settings)),
      ground_(fractal_ground(std::max(side_, 1.0F))),
      ground_box_(bounds_of(ground_->mesh)),
      plants_(
          detail_models(settings.all_leaves),
          [&] {
            growing::Planting planting;
            planting.count = settings.instances;
            planting.side = std::max(side_, 1.0F);
            planting.seed = settings.seed;
            for (const Plant& plant : forest_plants()) planting.shares.push_back(plant.share);
            return growing::scatter(planting, [&](float x, float z) { return height(x, z); });
          }(),
          progress) {
  ground_box_.low -= 0.01F;
  ground_box_.high += 0.01F;
}

float Forest::height(float x, float z) const {
  const float top = ground_box_.high.y + 1;
  const RayHit hit = ground_->index.closest({.origin = {x, top, z}, .direction = {0, -1, 0}});
  return hit.hit() ? top - hit.distance : 0;
}

RayMaterial Forest::material(const SurfacePoint& at) const {
  if (at.instance >= plants_.instances().size()) return soil(at);
  const growing::Instance& instance = plants_.instances()[at.instance];
  const growing::DetailModel& model = plants_.models()[instance.model];
  static const std::vector<const PaintedModel*> looks = [] {
    std::vector<const PaintedModel*> all;
    for (const Plant& plant : forest_plants()) all.push_back(&painted(plant.model));
    return all;
  }();
  RayMaterial material = looks[instance.model]->material(model.levels[0].system.symbols[at.mesh].name, at);
  // Plants differ a little in colour.
  const auto hue = [&](std::uint64_t k) { return static_cast<float>(random_share(instance.seed, 100 + k)); };
  const glm::vec3 tint{0.8F + 0.35F * hue(0), 0.85F + 0.25F * hue(1), 0.8F + 0.25F * hue(2)};
  material.albedo = glm::clamp(material.albedo * tint, 0.0F, 1.0F);
  return material;
}

namespace {

std::unique_ptr<RayPart> ray_part(const FaceMesh& faces) {
  ModelMesh triangles = triangles_of(faces);
  triangles.mesh.positions.shrink_to_fit();
  triangles.mesh.normals.shrink_to_fit();
  triangles.mesh.indices.shrink_to_fit();
  triangles.texture.shrink_to_fit();
  triangles.symbols.shrink_to_fit();
  return std::make_unique<RayPart>(std::move(triangles.mesh), std::move(triangles.texture),
                                   std::move(triangles.symbols));
}

}  // namespace

LazyForest::LazyForest(const Forest& forest, std::vector<std::uint8_t> levels, std::size_t cache_bytes)
    : plants_(forest.plants(), std::move(levels), cache_bytes, ray_part) {
  RayPart::index_objects();  // measured while this thread is alone
  const std::span<const growing::Instance> instances = forest.plants().instances();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    parts_.parts.push_back({forest.plants().box(i), growing::to_world(instances[i])});
  }
  parts_.parts.push_back({forest.ground_box()});
  parts_.light = model_daylight();
  parts_.open = [&, plants = instances.size()](std::uint32_t part,
                                               const std::function<void(const RayPart&)>& use) {
    if (part < plants) return plants_.open(part, use);
    use(forest.ground());
  };
  parts_.material = [&forest](const SurfacePoint& at) { return forest.material(at); };
}

Memory LazyForest::memory() const {
  Memory memory = plants_.memory();
  memory += index_memory(parts_.parts);
  return memory;
}

}  // namespace terrabench::meshgrow
