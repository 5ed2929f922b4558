#include "representations/procedural_mesh/lazy/detail.h"

#include <algorithm>
#include <glm/common.hpp>

#include "terrain/error.h"

namespace terrabench::growing {
namespace {

constexpr std::uint64_t kSamples = 4;  // seeds whose expansions a margin is measured on

void leave_out(Model& model, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::erase_if(model.steps, [&](const Step& step) { return step.name == name; }) > 0) continue;
    std::vector<std::string_view> all;
    for (const Step& step : model.steps) all.push_back(step.name);
    throw unknown_name("step", name, all);
  }
}

std::size_t steps_to_last_growth(const Model& model) {
  std::size_t steps = model.steps.size();
  while (steps > 0 && model.steps[steps - 1].levels > 0) --steps;
  return steps;
}

Model with_seed(const Model& model, std::uint64_t seed) {
  Model own = model;
  own.system.seed = seed;
  return own;
}

GrownMesh grow_only(const Model& model, std::uint64_t seed) {
  ExpandOptions options;
  options.most_steps = steps_to_last_growth(model);
  return expand(with_seed(model, seed), options);
}

// The first subdivision makes one face per corner; each further one four per face.
std::uint64_t faces_of(const Model& model, const FaceMesh& grown) {
  std::uint64_t faces = grown.faces();
  bool first = true;
  for (std::size_t s = steps_to_last_growth(model); s < model.steps.size(); ++s) {
    for (std::uint32_t i = 0; i < model.steps[s].levels; ++i, first = false) {
      faces = first ? grown.corners.size() : 4 * faces;
    }
  }
  return faces;
}

float measured_margin(const Model& model) {
  const bool displaced =
      std::any_of(model.steps.begin() + static_cast<std::ptrdiff_t>(steps_to_last_growth(model)),
                  model.steps.end(), [](const Step& step) { return !step.amounts.empty(); });
  float margin = 0;
  for (std::uint64_t seed = 0; displaced && seed < kSamples; ++seed) {
    const Bounds expanded = box_of(expand_seed(model, seed).mesh.positions);
    margin = std::max(margin, 2 * beyond(expanded, box_of(grow_only(model, seed).mesh.positions)));
  }
  return margin;
}

bool same_growth(const Model& a, const Model& b) {
  const std::size_t steps = steps_to_last_growth(a);
  if (steps != steps_to_last_growth(b)) return false;
  for (std::size_t s = 0; s < steps; ++s) {
    if (a.steps[s].place.line != b.steps[s].place.line || a.steps[s].levels != b.steps[s].levels)
      return false;
  }
  return a.system.tables == b.system.tables;
}

}  // namespace

DetailModel make_detail_model(std::string_view text, const std::string& name,
                              std::span<const DetailLevel> levels) {
  if (levels.empty()) throw usage_error("there is no level of detail", name, "give one or more");
  DetailModel result;
  result.name = name;
  for (const DetailLevel& level : levels) {
    Model model = parse_model(text, name, level.constants);
    leave_out(model, level.leave_out);
    if (leave_out_last(model, level.fewer_subdivisions) > 0) {
      throw usage_error("more subdivisions are left out than the model ends with", name, "leave out fewer");
    }
    result.margins.push_back(measured_margin(model));
    result.levels.push_back(std::move(model));
    std::uint32_t first = 0;
    while (!same_growth(result.levels[first], result.levels.back())) ++first;
    result.growth.push_back(first);
  }
  return result;
}

GrownMesh expand_seed(const Model& model, std::uint64_t seed) { return expand(with_seed(model, seed)); }

std::vector<Estimate> estimate(const DetailModel& model, std::uint64_t seed) {
  std::vector<Estimate> result(model.levels.size());
  GrownMesh grown;
  for (std::size_t l = 0; l < model.levels.size(); ++l) {
    if (model.growth[l] != l) continue;
    grown = grow_only(model.levels[l], seed);
    const Bounds box = box_of(grown.mesh.positions);
    for (std::size_t same = l; same < model.levels.size(); ++same) {
      if (model.growth[same] != l) continue;
      const float margin = model.margins[same];
      result[same] = {faces_of(model.levels[same], grown.mesh), {box.low - margin, box.high + margin}};
    }
  }
  return result;
}

float beyond(const Bounds& inner, const Bounds& box) {
  const glm::vec3 d = glm::max(box.low - inner.low, inner.high - box.high);
  return std::max({d.x, d.y, d.z, 0.0F});
}

}  // namespace terrabench::growing
