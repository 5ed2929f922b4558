#include "representations/procedural_mesh/lazy/planted_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "terrain/error.h"
#include "terrain/frustum.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

constexpr std::size_t kMostLevels = 16;
// Per instance: itself, two boxes, and numbers of faces.
constexpr std::uint64_t kInstanceBytes =
    sizeof(Instance) + 2 * sizeof(Bounds) + (kMostLevels + 1) * sizeof(std::uint32_t);

double total(std::span<const double> shares) { return std::accumulate(shares.begin(), shares.end(), 0.0); }

void check(const Planting& planting) {
  const std::uint64_t most = planting.most_bytes / kInstanceBytes;
  if (planting.count > most) {
    throw bad_input(fmt::format("{} instances take more than the budget of {} bytes", planting.count,
                                planting.most_bytes),
                    "planted scene", fmt::format("plant at most {}, or raise the budget", most));
  }
  const auto is_share = [](double share) { return share >= 0 && std::isfinite(share); };
  if (!std::ranges::all_of(planting.shares, is_share) || !(total(planting.shares) > 0)) {
    throw bad_input("the shares of the models must be 0 or more, and one above 0", "planted scene",
                    "give one share per model");
  }
  if (!(planting.side > 0) || !std::isfinite(planting.side) || !(planting.least_scale > 0) ||
      !(planting.most_scale >= planting.least_scale) || !std::isfinite(planting.most_scale)) {
    throw bad_input("the side of the square and the scales must be above 0 and finite", "planted scene",
                    "give metres and factors");
  }
}

std::uint32_t chosen(std::span<const double> shares, double at) {
  std::uint32_t model = 0;
  for (double left = at * total(shares); model + 1 < shares.size() && left >= shares[model]; ++model) {
    left -= shares[model];
  }
  while (shares[model] == 0) --model;  // rounding took it past the last with a share
  return model;
}

void check(const Instance& instance, std::size_t number, std::size_t models) {
  const glm::vec3& p = instance.position;
  const std::string where = fmt::format("instance {}", number);
  if (instance.model >= models) {
    throw bad_input(fmt::format("model {} of {} does not exist", instance.model, models), where,
                    "name one of the models");
  }
  if (!std::isfinite(p.x + p.y + p.z + instance.turn) || !(instance.scale > 0) ||
      !std::isfinite(instance.scale)) {
    throw bad_input("the position, turn or scale is not finite, or the scale not above 0", where,
                    "correct its placement");
  }
}

Bounds joined(const std::vector<Estimate>& levels) {
  std::vector<glm::vec3> corners;
  for (const Estimate& level : levels) corners.insert(corners.end(), {level.box.low, level.box.high});
  return box_of(corners);
}

// Of the corners, widened by the rounding of their transformation.
Bounds transformed(const Bounds& box, const glm::mat4& matrix) {
  std::vector<glm::vec3> corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(matrix * glm::vec4(box.corner(k), 1));
  Bounds result = box_of(corners);
  const glm::vec3 size = glm::max(glm::abs(result.low), glm::abs(result.high));
  const float rounding = 0x1p-20F * std::max({size.x, size.y, size.z});
  return {result.low - rounding, result.high + rounding};
}

}  // namespace

glm::mat4 to_world(const Instance& instance) {
  const float c = instance.scale * std::cos(instance.turn), s = instance.scale * std::sin(instance.turn);
  return {{c, 0, -s, 0}, {0, instance.scale, 0, 0}, {s, 0, c, 0}, glm::vec4(instance.position, 1)};
}

std::vector<Instance> scatter(const Planting& planting,
                              const std::function<float(float x, float z)>& height) {
  check(planting);
  std::vector<Instance> instances(planting.count);
  const auto across = static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(planting.count))));
  const double cell = planting.side / static_cast<double>(std::max<std::uint64_t>(across, 1));
  tbb::parallel_for(std::size_t{0}, instances.size(), [&](std::size_t i) {
    const std::uint64_t key = combine(planting.seed, i);
    Instance& instance = instances[i];
    const std::size_t row = i / across;  // the last row may be short
    instance.position.x = static_cast<float>((static_cast<double>(i % across) + random_share(key, 0)) * cell);
    instance.position.z = static_cast<float>((static_cast<double>(row) + random_share(key, 1)) * cell);
    instance.position.y = height(instance.position.x, instance.position.z);
    instance.turn = static_cast<float>(2 * std::numbers::pi * random_share(key, 2));
    instance.scale =
        std::lerp(planting.least_scale, planting.most_scale, static_cast<float>(random_share(key, 3)));
    instance.model = chosen(planting.shares, random_share(key, 4));
    instance.seed = key;
  });
  return instances;
}

PlantedScene::PlantedScene(std::vector<DetailModel> models, std::vector<Instance> instances,
                           Progress* progress)
    : models_(std::move(models)), instances_(std::move(instances)) {
  std::uint32_t levels = 0;
  for (const DetailModel& model : models_) {
    if (model.levels.size() > kMostLevels) {
      throw usage_error(fmt::format("{} levels are more than {}", model.levels.size(), kMostLevels),
                        model.name, "leave levels out");
    }
  }
  first_level_.reserve(instances_.size());
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    check(instances_[i], i, models_.size());
    first_level_.push_back(levels);
    levels += static_cast<std::uint32_t>(models_[instances_[i].model].levels.size());
  }
  faces_.resize(levels);
  boxes_.resize(instances_.size());
  local_boxes_.resize(instances_.size());
  if (progress != nullptr) progress->begin("estimate the instances", instances_.size());
  tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t i) {
    const Instance& instance = instances_[i];
    const std::vector<Estimate> seen = estimate(models_[instance.model], instance.seed);
    for (std::size_t l = 0; l < seen.size(); ++l) {
      if (l > 0 && seen[l].faces > seen[l - 1].faces) {
        throw bad_input(fmt::format("level {} has {} faces, more than the {} of the level before", l,
                                    seen[l].faces, seen[l - 1].faces),
                        models_[instance.model].name, "order the levels from fine to coarse");
      }
      faces_[first_level_[i] + l] = static_cast<std::uint32_t>(seen[l].faces);
    }
    local_boxes_[i] = joined(seen);
    boxes_[i] = transformed(local_boxes_[i], to_world(instance));
    if (progress != nullptr) progress->advance();
  });
  for (std::size_t i = 0; i < instances_.size(); ++i) total_ += faces(i, 0);
  if (progress != nullptr) progress->end();
}

GrownMesh PlantedScene::mesh(std::size_t instance, std::size_t level) const {
  const Instance& at = instances_[instance];
  return expand_seed(models_[at.model].levels[level], at.seed);
}

std::vector<std::uint8_t> PlantedScene::choose_levels(const View& view,
                                                      const DetailSettings& settings) const {
  const Frustum frustum(view);
  std::vector<std::uint8_t> chosen_levels(instances_.size());
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const bool out = frustum.see(boxes_[i]) == Sight::kOutside;
    const double disc = disc_pixels(view, 0.5F * (boxes_[i].low + boxes_[i].high),
                                    0.5F * glm::length(boxes_[i].high - boxes_[i].low));
    chosen_levels[i] = static_cast<std::uint8_t>(
        coarsest_level({faces_.data() + first_level_[i], levels(i)}, disc,
                       out ? settings.out_of_view * settings.spacing : settings.spacing));
  }
  return chosen_levels;
}

Memory PlantedScene::memory() const {
  Memory memory = payload_memory(instances_, boxes_, local_boxes_);
  memory += index_memory(first_level_, faces_);
  return memory;
}

std::size_t coarsest_level(std::span<const std::uint32_t> faces, double disc, double spacing) {
  std::size_t level = faces.empty() ? 0 : faces.size() - 1;
  while (level > 0 && !(faces[level] * spacing * spacing >= disc)) --level;
  return level;
}

double disc_pixels(const View& view, const glm::vec3& middle, float radius) {
  const double distance = glm::distance(glm::dvec3(view.eye), glm::dvec3(middle)) - radius;
  if (!(distance > 0)) return std::numeric_limits<double>::infinity();
  const double pixels = 0.5 * view.height / std::tan(0.5 * view.vertical_fov);  // per unit of slope
  const double seen = pixels * radius / distance;
  return std::numbers::pi * seen * seen;
}

}  // namespace terrabench::growing
