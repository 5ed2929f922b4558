#include "representations/procedural_mesh/lazy/detail.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>

#include "terrain/error.h"
#include "terrain/toml.h"

namespace terrabench::growing {
namespace {

constexpr std::uint64_t kSamples = 4;  // seeds whose expansions a margin is measured on

// Where a line and column, from 1, lie in a text whose line has only ASCII characters before it.
std::size_t offset_of(std::string_view text, toml::source_position at) {
  std::size_t offset = 0;
  for (toml::source_index line = 1; line < at.line; ++line) offset = text.find('\n', offset) + 1;
  return offset + at.column - 1;
}

const toml::node* find_constant(const toml::table& file, const std::string& name) {
  const toml::table* const constants = file["constants"].as_table();
  const toml::node* const value = constants == nullptr ? nullptr : constants->get(name);
  if (value != nullptr && value->is_number()) return value;
  std::vector<std::string_view> names;
  if (constants != nullptr) {
    for (const auto& [key, other] : *constants) {
      if (other.is_number()) names.push_back(key.str());
    }
  }
  throw unknown_name("constant", name, names);
}

// The value is exchanged in the text: the order of a model's definitions matters, and a TOML table does not
// keep it.
std::string with_constant(std::string text, const std::string& name, const ConstantChange& change) {
  constexpr std::string_view kAdvice = "correct the file; see docs/models.md";
  {
    const toml::table file = parse_toml(text, name, kAdvice);
    const toml::source_region place = find_constant(file, change.name)->source();
    const std::size_t begin = offset_of(text, place.begin), end = offset_of(text, place.end);
    if (!(begin <= end && end <= text.size())) {
      throw bad_input(fmt::format("the constant '{}' is not in a line of its own", change.name), name,
                      "put it into one");
    }
    text.replace(begin, end - begin, fmt::format("{}", change.value));
  }
  const toml::table changed = parse_toml(text, name, kAdvice);
  if (find_constant(changed, change.name)->value<double>() == change.value) return text;
  throw bad_input(fmt::format("the constant '{}' cannot be set to {}", change.name, change.value), name,
                  "write it in a line of its own, and give it a finite value");
}

void leave_out(Model& model, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto named = [&](const Step& step) { return step.name == name; };
    const auto first = std::remove_if(model.steps.begin(), model.steps.end(), named);
    if (first == model.steps.end()) {
      std::vector<std::string_view> all;
      for (const Step& step : model.steps) all.push_back(step.name);
      throw unknown_name("step", name, all);
    }
    model.steps.erase(first, model.steps.end());
  }
}

void subdivide_less(Model& model, std::uint32_t levels, const std::string& name) {
  while (levels > 0) {
    if (model.steps.empty() || model.steps.back().levels == 0) {
      throw usage_error("more subdivisions are left out than the model ends with", name, "leave out fewer");
    }
    const std::uint32_t taken = std::min(levels, model.steps.back().levels);
    levels -= taken;
    model.steps.back().levels -= taken;
    if (model.steps.back().levels == 0) model.steps.pop_back();
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
  bool displaced = false;
  for (std::size_t s = steps_to_last_growth(model); s < model.steps.size(); ++s) {
    displaced = displaced || !model.steps[s].displacements.empty();
  }
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
    std::string changed(text);
    for (const ConstantChange& change : level.constants) changed = with_constant(changed, name, change);
    Model model = parse_model(changed, name);
    leave_out(model, level.leave_out);
    subdivide_less(model, level.fewer_subdivisions, name);
    result.margins.push_back(measured_margin(model));
    result.levels.push_back(std::move(model));
    std::uint32_t first = 0;
    while (!same_growth(result.levels[first], result.levels.back())) ++first;
    result.growth.push_back(first);
  }
  return result;
}

GrownMesh expand_seed(const Model& model, std::uint64_t seed) { return expand(with_seed(model, seed)); }

std::vector<Foreseen> foresee(const DetailModel& model, std::uint64_t seed) {
  std::vector<Foreseen> result(model.levels.size());
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

Bounds box_of(const std::vector<glm::vec3>& positions) {
  if (positions.empty()) return {};
  Bounds box{positions[0], positions[0]};
  for (const glm::vec3& p : positions) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

float beyond(const Bounds& inner, const Bounds& box) {
  const glm::vec3 d = glm::max(box.low - inner.low, inner.high - box.high);
  return std::max({d.x, d.y, d.z, 0.0F});
}

}  // namespace terrabench::growing
