// The schedule of a model: [[step]] tables.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "representations/procedural_mesh/model_reader.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

bool linear(Table& table, std::string_view key, const std::string& file) {
  const std::string text = table.text_or(key, "standard");
  if (text == "linear" || text == "standard") return text == "linear";
  fail_at(*table.find(key), file, fmt::format("'{}' must be standard or linear, got '{}'", key, text),
          "write one");
}

Displace displacement(ModelReader& models, const toml::node& node, const Names& names) {
  Table table(node, models.file, "displace");
  Displace result;
  if (const toml::node* const along = table.find("along"); along != nullptr && along->is_array()) {
    result.along = Displace::Along::kFixed;
    result.direction = glm::vec3(table.vector_or("along", {0, 1, 0}));
    if (!(glm::length(result.direction) > 0))
      fail_at(*along, models.file, "'along' has no direction", "correct it");
  } else {
    const std::string text = table.text_or("along", "normal");
    constexpr std::string_view kAxes[] = {"normal", "tangent", "bitangent"};
    const auto* const found = std::find(std::begin(kAxes), std::end(kAxes), text);
    if (found == std::end(kAxes)) {
      fail_at(*along, models.file, fmt::format("unknown direction '{}'", text),
              "write normal, tangent, bitangent or [x, y, z]");
    }
    result.along = static_cast<Displace::Along>(found - std::begin(kAxes));
  }
  const std::string unit = table.text_or("unit", "scale");
  if (unit != "scale" && unit != "metre") {
    fail_at(*table.find("unit"), models.file, fmt::format("unknown unit '{}'", unit), "write scale or metre");
  }
  result.by_scale = unit == "scale";
  result.new_vertices = table.flag_or("new_only", false);
  result.amount = models.expression(table.get("amount"), names);
  table.done();
  return result;
}

void subdivision(ModelReader& models, Table& table, Step& step) {
  step.levels = static_cast<std::uint32_t>(table.integer_or("subdivide", 1, 1, 20));
  step.linear = linear(table, "place", models.file);
  step.linear_texture = linear(table, "texture", models.file);
  step.bound = table.number_or("bound", 0);
  if (step.bound < 0) fail_at(*table.find("bound"), models.file, "'bound' must be 0 or more", "correct it");
  const toml::node* const displace = table.find("displace");
  if (displace == nullptr) return;
  Names names(&models.constants);
  for (const std::string_view name : kVertexNames) names.add_variable(name, models.file, place_of(*displace));
  if (displace->is_array()) {
    for (const toml::node& entry : *displace->as_array()) {
      step.displacements.push_back(displacement(models, entry, names));
    }
  } else {
    step.displacements.push_back(displacement(models, *displace, names));
  }
}

void growth(ModelReader& models, Table& table, const toml::node& grow, Step& step) {
  if (grow.is_string()) {
    step.growth.to_the_end = text_of(grow, models.file, "grow") == "all";
    if (!step.growth.to_the_end)
      fail_at(grow, models.file, "'grow' must be a number or \"all\"", "write one");
  } else {
    step.growth.steps = static_cast<std::uint32_t>(table.integer_or("grow", 1, 1, 1'000'000));
  }
  if (const toml::node* const only = table.find("only")) {
    step.growth.only.assign(models.model.system.symbols.size(), false);
    for (const toml::node& node : list_of(*only, models.file, "only", 0)) {
      const std::string name = text_of(node, models.file, "only");
      const std::optional<std::uint32_t> symbol = models.symbol(name);
      if (!symbol || *symbol == kNoSymbol) {
        fail_at(node, models.file, fmt::format("unknown symbol '{}'", name), "list it in [symbols]");
      }
      step.growth.only[*symbol] = true;
    }
  }
}

}  // namespace

void read_steps(ModelReader& models, const toml::node* node) {
  if (node == nullptr) return;
  for (const toml::node& entry : list_of(*node, models.file, "step", 0)) {
    Table table(entry, models.file, "step");
    Step step;
    step.place = place_of(entry);
    step.name = table.text_or("name", "");
    const toml::node* const grow = table.find("grow");
    const toml::node* const levels = table.find("subdivide");
    if ((grow == nullptr) == (levels == nullptr)) {
      fail_at(entry, models.file, "a step must either grow or subdivide", "give it 'grow' or 'subdivide'");
    }
    if (grow != nullptr) {
      growth(models, table, *grow, step);
    } else {
      subdivision(models, table, step);
    }
    table.done();
    step.growth.limits = models.model.limits;
    models.model.steps.push_back(std::move(step));
  }
}

}  // namespace terrabench::growing
