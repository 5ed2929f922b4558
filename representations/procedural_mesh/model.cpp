#include "representations/procedural_mesh/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "representations/procedural_mesh/model_reader.h"
#include "terrain/embedded.h"
#include "terrain/error.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_models();

namespace growing {
namespace {

constexpr std::size_t kMostParameters = 64;

// Numbers, lists of numbers, or expressions of the constants before.
void read_constants(ModelReader& models, const toml::node* node, std::span<const ConstantChange> changes) {
  std::vector<std::pair<std::string, const toml::node*>> entries;
  if (node != nullptr) entries = Table(*node, models.file, "constants").entries();
  std::vector<std::string_view> single;
  for (const auto& [name, value] : entries) {
    if (value->is_number()) single.push_back(name);
  }
  for (const ConstantChange& change : changes) {
    if (std::ranges::count(single, change.name) == 0) throw unknown_name("constant", change.name, single);
  }
  for (const auto& [name, value] : entries) {
    const auto change = std::ranges::find(changes, name, &ConstantChange::name);
    std::vector<double> numbers;
    if (change != changes.end()) {
      numbers.push_back(change->value);
    } else if (const toml::array* const list = value->as_array()) {
      for (const toml::node& entry : *list) numbers.push_back(number_of(entry, models.file, name));
      if (numbers.empty())
        fail_at(*value, models.file, fmt::format("'{}' is empty", name), "give it a number");
    } else {
      const Expression e = models.expression(*value, models.constants);
      numbers.push_back(evaluate(e, {{}, models.constants.tables(), models.model.system.seed}));
    }
    if (!std::isfinite(numbers[0]))
      fail_at(*value, models.file, fmt::format("'{}' is not finite", name), "correct it");
    models.constants.add_table(name, std::move(numbers), models.file, place_of(*value));
  }
}

void read_symbols(ModelReader& models, const toml::node* node) {
  models.model.system.symbols.push_back({"none", {}});
  models.symbol_numbers.emplace("none", kNoSymbol);
  if (node == nullptr) return;
  for (const auto& [name, value] : Table(*node, models.file, "symbols").entries()) {
    Names names(&models.constants);  // refuses what is no name, and names in use
    for (const std::string_view shared : kSharedNames)
      names.add_variable(shared, models.file, place_of(*node));
    names.add_variable(name, models.file, place_of(*value));
    if (name == "none") fail_at(*value, models.file, "the symbol 'none' is built in", "choose another name");
    Symbol symbol;
    symbol.name = name;
    for (const toml::node& parameter : list_of(*value, models.file, name, 0)) {
      symbol.parameters.push_back(text_of(parameter, models.file, name));
      names.add_variable(symbol.parameters.back(), models.file, place_of(parameter));
    }
    if (symbol.parameters.size() > kMostParameters) {
      fail_at(*value, models.file, fmt::format("a symbol must have at most {} parameters", kMostParameters),
              "remove some");
    }
    models.symbol_numbers.emplace(name, static_cast<std::uint32_t>(models.model.system.symbols.size()));
    models.model.system.symbols.push_back(std::move(symbol));
  }
  // Where a symbol may stand, a variable of its name could not be read.
  for (const Symbol& symbol : models.model.system.symbols) {
    for (const std::string& parameter : symbol.parameters) {
      if (!models.symbol(parameter)) continue;
      fail_at(*node, models.file,
              fmt::format("the parameter '{}' of '{}' has the name of a symbol", parameter, symbol.name),
              "choose another name");
    }
  }
}

void read_limits(ModelReader& models, const toml::node* node) {
  if (node == nullptr) return;
  Table table(*node, models.file, "limits");
  Limits& limits = models.model.limits;
  limits.faces = static_cast<std::size_t>(
      table.integer_or("faces", static_cast<std::int64_t>(limits.faces), 1, 100'000'000));
  limits.steps = static_cast<std::uint32_t>(table.integer_or("steps", limits.steps, 1, 1'000'000));
  table.done();
}

}  // namespace

Model parse_model(std::string_view text, const std::string& origin, std::span<const ConstantChange> changes) {
  if (text.size() > kMostModelBytes) {
    throw bad_input(fmt::format("a model must have at most {} bytes, got {}", kMostModelBytes, text.size()),
                    origin, "remove rules or vertices");
  }
  const toml::table file = parse_toml(text, origin, "correct the file; see docs/models.md");
  Table table(file, origin, "model");
  Model model;
  model.bytes = text.size();
  model.system.file = origin;
  model.title = table.text_or("title", "");
  model.system.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, 0, INT64_MAX));
  ModelReader models{model, model.system.file};
  read_limits(models, table.find("limits"));
  read_constants(models, table.find("constants"), changes);
  read_symbols(models, table.find("symbols"));
  read_rules(models, table.find("rule"));
  read_base(models, table.get("base"));
  read_steps(models, table.find("step"));
  table.done();
  const std::span<const double> tables = models.constants.tables();
  model.system.tables.assign(tables.begin(), tables.end());
  if (model.base.faces() > model.limits.faces) {
    throw bad_input(
        fmt::format("the base mesh has {} faces, more than {}", model.base.faces(), model.limits.faces),
        origin, "make it coarser, or raise the limit of faces, to 100,000,000 at most");
  }
  return model;
}

namespace {

using Texts = std::map<std::string, std::string, std::less<>>;

const Texts& built_in_models() {
  static const Texts all = [] {
    Texts models, rules;  // rules: by folder
    for (const EmbeddedFile& file : embedded_models()) {
      const std::filesystem::path path(file.name);
      if (path.stem() == "rules") rules[path.parent_path()] = fmt::format("\n{}", file.text);
    }
    for (const EmbeddedFile& file : embedded_models()) {
      const std::filesystem::path path(file.name);
      if (path.stem() != "rules") models[path.stem()] = std::string(file.text) + rules[path.parent_path()];
    }
    return models;
  }();
  return all;
}

}  // namespace

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const auto& [name, text] : built_in_models()) names.push_back(name);
  return names;
}

std::string_view model_text(std::string_view name) {
  const auto found = built_in_models().find(name);
  if (found != built_in_models().end()) return found->second;
  const std::vector<std::string> names = model_names();
  throw unknown_name("model", name, std::vector<std::string_view>(names.begin(), names.end()));
}

}  // namespace growing
}  // namespace terrabench
