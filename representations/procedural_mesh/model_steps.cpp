// The schedule of a model: [[step]] tables.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "representations/procedural_mesh/model_reader.h"

namespace terrabench::growing {
namespace {

// The index of a word; 0 where there is none.
std::size_t word_or_first(Table& table, std::string_view key, std::span<const std::string_view> words) {
  return table.has(key) ? table.word(key, words) : 0;
}

subdivision::Base placement(Table& table, std::string_view key) {
  constexpr std::string_view kWords[] = {"standard", "linear"};
  return static_cast<subdivision::Base>(word_or_first(table, key, kWords));
}

void displacement(ModelReader& models, const toml::node& node, const Names& names, Step& step) {
  using namespace subdivision;
  constexpr std::string_view kAxes[] = {"normal", "tangent", "bitangent"}, kUnits[] = {"scale", "metre"};
  Table table(node, models.file, "displace");
  Displacement& result = step.placement.displacements.emplace_back();
  if (const toml::node* const along = table.find("along"); along != nullptr && along->is_array()) {
    result.axis = Axis::kFixed;
    result.direction = table.vector<glm::vec3>("along");
    if (!(glm::length(result.direction) > 0))
      fail_at(*along, models.file, "'along' has no direction", "correct it");
  } else {
    result.axis = static_cast<Axis>(word_or_first(table, "along", kAxes));
  }
  result.by_scale = word_or_first(table, "unit", kUnits) == 0;
  result.where = table.flag_or("new_only", false) ? Where::kNewVertices : Where::kEveryVertex;
  step.amounts.push_back(models.expression(table.get("amount"), names));
  table.done();
}

void read_subdivision(ModelReader& models, Table& table, Step& step) {
  step.levels = static_cast<std::uint32_t>(table.integer_or("subdivide", 1, 1, 20));
  step.placement.base = placement(table, "place");
  step.placement.texture = placement(table, "texture");
  const double bound = table.number_or("bound", 0, 0);
  if (bound > 0) step.placement.bound = static_cast<float>(bound);
  const toml::node* const displace = table.find("displace");
  if (displace == nullptr) return;
  Names names(&models.constants);
  for (const std::string_view name : kVertexNames) names.add_variable(name, models.file, place_of(*displace));
  if (!displace->is_array()) return displacement(models, *displace, names, step);
  for (const toml::node& entry : *displace->as_array()) displacement(models, entry, names, step);
}

void read_growth(ModelReader& models, Table& table, const toml::node& grow, Step& step) {
  if (grow.is_string()) {
    step.growth.to_the_end = text_of(grow, models.file, "grow") == "all";
    if (!step.growth.to_the_end)
      fail_at(grow, models.file, "'grow' must be a number or \"all\"", "write one");
  } else {
    step.growth.steps = static_cast<std::uint32_t>(table.integer_or("grow", 1, 1, 1'000'000));
  }
  if (!table.has("only")) return;
  step.growth.only.assign(models.model.system.symbols.size(), false);
  for (const toml::node& node : table.list("only")) step.growth.only[models.symbol(node, "only")] = true;
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
    if ((grow == nullptr) == !table.has("subdivide")) {
      table.fail("a step must either grow or subdivide", "give it 'grow' or 'subdivide'");
    }
    if (grow != nullptr) {
      read_growth(models, table, *grow, step);
    } else {
      read_subdivision(models, table, step);
    }
    table.done();
    step.growth.limits = models.model.limits;
    models.model.steps.push_back(std::move(step));
  }
}

}  // namespace terrabench::growing
