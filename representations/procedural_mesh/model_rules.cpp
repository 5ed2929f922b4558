// The rules of a model: [[rule]] tables.
#include <fmt/format.h>

#include <algorithm>

#include "representations/procedural_mesh/model_reader.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

std::size_t operations_of(const SymbolChoice& choice) {
  std::size_t count = 0;
  for (const SymbolChoice::Option& option : choice.options) {
    count += 4 + option.condition.code.size();
    for (const Expression& e : option.arguments) count += 4 + e.code.size();
  }
  return count;
}

class RuleReader {
 public:
  RuleReader(ModelReader& models, const toml::node& node)
      : models_(models), file_(models.file), names_(&models.constants), table_(node, models.file, "rule") {}

  Rule run() {
    rule_.place = place_of(table_.node());
    name_variables();
    rule_.when = optional(table_, "when");
    rule_.probability = optional(table_, "probability");
    if (const toml::node* const node = table_.find("let")) locals(*node);
    const toml::node* const sections = table_.find("sections");
    const toml::node* const faces = table_.find("faces");
    if ((sections == nullptr) == (faces == nullptr)) {
      table_.fail("a rule without a template", "give it either 'sections' or 'corners' and 'faces'");
    }
    if (sections != nullptr) {
      extruded(*sections);
    } else {
      mesh(*faces);
    }
    table_.done();
    return std::move(rule_);
  }

 private:
  void name_variables() {
    for (const std::string_view name : kSharedNames) names_.add_variable(name, file_, rule_.place);
    const toml::node& node = table_.get("symbol");
    rule_.symbol = models_.symbol(node, "symbol");
    for (const std::string& parameter : models_.model.system.symbols[rule_.symbol].parameters) {
      names_.add_variable(parameter, file_, place_of(node));
    }
    rule_.first_local = names_.variables();
  }

  void locals(const toml::node& node) {
    for (const auto& [name, value] : Table(node, file_, "let").entries()) {
      if (models_.symbol(name)) {
        fail_at(*value, file_, fmt::format("'{}' is a symbol", name), "choose another name");
      }
      rule_.locals.push_back(expression(*value));
      if (names_.add_variable(name, file_, place_of(*value)) >= kMostSlots) {
        fail_at(*value, file_, fmt::format("a rule must have at most {} names", kMostSlots), "remove some");
      }
    }
  }

  Expression expression(const toml::node& node) { return models_.expression(node, names_); }

  Expression optional(Table& table, std::string_view key) {
    const toml::node* const node = table.find(key);
    return node == nullptr ? Expression() : expression(*node);
  }

  template <std::size_t n>
  std::array<Expression, n> several(const toml::node& node, std::string_view what) {
    std::array<Expression, n> result;
    const toml::array& list = list_of(node, file_, what, n);
    for (std::size_t i = 0; i < n; ++i) result[i] = expression(list[i]);
    return result;
  }

  // One value for all corners, or a list with one per corner.
  template <class Read>
  auto per_corner(const toml::node& node, const Read& read) {
    std::vector<decltype(read(node))> result;
    const toml::array* const list = node.as_array();
    if (list == nullptr) {
      result.push_back(read(node));
      return result;
    }
    for (const toml::node& entry : *list) result.push_back(read(entry));
    std::uint32_t& corners = rule_.replacement.corners;
    if (result.size() < 3 || (corners != 0 && corners != result.size())) {
      fail_at(node, file_, fmt::format("a list of {} for a base of {} corners", result.size(), corners),
              "give one value per corner, and the same number in the whole rule");
    }
    corners = static_cast<std::uint32_t>(result.size());
    return result;
  }

  std::vector<TextureAt> texture(Table& table) {
    const toml::node* const u = table.find("u");
    const toml::node* const v = table.find("v");
    if (u == nullptr && v == nullptr) return {};
    if (u == nullptr || v == nullptr) table.fail("'u' needs 'v', and 'v' needs 'u'", "give both");
    const auto read = [this](const toml::node& node) { return expression(node); };
    const std::vector<Expression> us = per_corner(*u, read), vs = per_corner(*v, read);
    const std::vector<Expression>& shorter = us.size() < vs.size() ? us : vs;
    std::vector<TextureAt> result(std::max(us.size(), vs.size()));
    if (us.size() != vs.size()) {
      models_.count_copies(table.node(), result.size(), shorter[0].code.size());
    }
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = {us[i % us.size()], vs[i % vs.size()]};
    return result;
  }

  Section section(const toml::node& node) {
    Table table(node, file_, "sections");
    Section result;
    if (const toml::node* const move = table.find("move")) {
      if (move->is_array()) {
        result.move = several<3>(*move, "move");
      } else {
        result.move[2] = expression(*move);
      }
    }
    if (const toml::node* const turned = table.find("turn")) result.turn = several<3>(*turned, "turn");
    result.tropism = optional(table, "tropism");
    result.scale = optional(table, "scale");
    result.radius = optional(table, "radius");
    if (result.scale.given() && result.radius.given()) {
      table.fail("a section has both 'scale' and 'radius'", "leave out one: both set its size");
    }
    if (const toml::node* const by = table.find("stretch")) result.stretch = several<2>(*by, "stretch");
    result.texture = texture(table);
    result.crease = static_cast<int>(table.integer_or("crease", 0, 0, 100));
    if (const toml::node* const sides = table.find("sides")) {
      result.sides = per_corner(*sides, [this](const toml::node& n) { return models_.choice(n, names_); });
    } else {
      result.sides.emplace_back();
    }
    table.done();
    return result;
  }

  void extruded(const toml::node& node) {
    const toml::array& list = list_of(node, file_, "sections", 0);
    if (list.empty()) fail_at(node, file_, "'sections' is empty", "give at least one");
    for (const toml::node& entry : list) rule_.replacement.sections.push_back(section(entry));
    if (const toml::node* const cap = table_.find("cap"))
      rule_.replacement.cap = models_.choice(*cap, names_);
    if (const toml::node* const base = table_.find("base")) {
      Table table(*base, file_, "base");
      rule_.replacement.texture = texture(table);
      table.done();
    }
  }

  void mesh(const toml::node& faces) {
    Template& t = rule_.replacement;
    table_.get("corners");
    t.corners = static_cast<std::uint32_t>(table_.integer_or("corners", 0, 3, 1000));
    if (const toml::node* const vertices = table_.find("vertices")) {
      for (const toml::node& v : list_of(*vertices, file_, "vertices", 0)) t.vertices.push_back(vertex(v));
    }
    models_.read_faces(faces, t.mesh);
    face_symbols();
    if (const toml::node* const node = table_.find("texture")) {
      for (const toml::node& at : list_of(*node, file_, "texture", t.corners + t.vertices.size())) {
        const auto [u, v] = several<2>(at, "texture");
        t.texture.push_back({u, v});
      }
    }
    const subdivision::Topology topology = check_template(t, models_.where(faces));
    if (const toml::node* const creases = table_.find("creases")) {
      t.mesh.creases = models_.read_creases(*creases, topology);
    }
  }

  TemplateVertex vertex(const toml::node& node) {
    TemplateVertex result;
    if (node.is_array()) {
      result.offset = several<3>(node, "vertices");
      return result;
    }
    Table table(node, file_, "vertices");
    for (const toml::node& weight : table.list("mix", rule_.replacement.corners)) {
      result.weights.push_back(expression(weight));
    }
    if (const toml::node* const move = table.find("move")) result.offset = several<3>(*move, "move");
    table.done();
    return result;
  }

  void face_symbols() {
    Template& t = rule_.replacement;
    const toml::node* const symbols = table_.find("symbols");
    if (symbols == nullptr) {
      t.symbols.resize(t.mesh.faces());
    } else if (symbols->is_string()) {
      const SymbolChoice choice = models_.choice(*symbols, names_);
      models_.count_copies(*symbols, t.mesh.faces(), operations_of(choice));
      t.symbols.assign(t.mesh.faces(), choice);
    } else {
      for (const toml::node& symbol : list_of(*symbols, file_, "symbols", t.mesh.faces())) {
        t.symbols.push_back(models_.choice(symbol, names_));
      }
    }
  }

  ModelReader& models_;
  const std::string& file_;
  Names names_;
  Table table_;
  Rule rule_;
};

}  // namespace

void read_rules(ModelReader& models, const toml::node* node) {
  if (node == nullptr) return;
  std::vector<Rule>& rules = models.model.system.rules;
  for (const toml::node& entry : list_of(*node, models.file, "rule", 0)) {
    rules.push_back(RuleReader(models, entry).run());
  }
  std::ranges::stable_sort(rules, {}, &Rule::symbol);
  for (std::uint32_t r = 0; r < rules.size(); ++r) {
    Symbol& symbol = models.model.system.symbols[rules[r].symbol];
    if (symbol.rules++ == 0) symbol.first_rule = r;
  }
}

}  // namespace terrabench::growing
