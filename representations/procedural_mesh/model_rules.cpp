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
    if (const toml::node* const node = table_.find("when")) rule_.when = models_.expression(*node, names_);
    if (const toml::node* const node = table_.find("probability")) {
      rule_.probability = models_.expression(*node, names_);
    }
    if (const toml::node* const node = table_.find("let")) locals(*node);
    const toml::node* const sections = table_.find("sections");
    const toml::node* const faces = table_.find("faces");
    if ((sections == nullptr) == (faces == nullptr)) {
      fail_at(table_.node(), file_, "a rule without a template",
              "give it either 'sections' or 'corners' and 'faces'");
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
    const std::string name = text_of(node, file_, "symbol");
    const std::optional<std::uint32_t> symbol = models_.symbol(name);
    if (!symbol || *symbol == kNoSymbol) {
      fail_at(node, file_, fmt::format("unknown symbol '{}'", name), "list it in [symbols]");
    }
    rule_.symbol = *symbol;
    for (const std::string& parameter : models_.model.system.symbols[*symbol].parameters) {
      names_.add_variable(parameter, file_, place_of(node));
    }
    rule_.first_local = names_.variables();
  }

  void locals(const toml::node& node) {
    for (const auto& [name, value] : Table(node, file_, "let").entries()) {
      if (models_.symbol(name)) {
        fail_at(*value, file_, fmt::format("'{}' is a symbol", name), "choose another name");
      }
      rule_.locals.push_back(models_.expression(*value, names_));
      if (names_.add_variable(name, file_, place_of(*value)) >= kMostSlots) {
        fail_at(*value, file_, fmt::format("a rule must have at most {} names", kMostSlots), "remove some");
      }
    }
  }

  std::array<Expression, 3> three(const toml::node& node, std::string_view what) {
    std::array<Expression, 3> result;
    const toml::array& list = list_of(node, file_, what, 3);
    for (std::size_t i = 0; i < 3; ++i) result[i] = models_.expression(list[i], names_);
    return result;
  }

  // One expression for all corners, or one per corner.
  std::vector<Expression> per_corner(const toml::node& node) {
    std::vector<Expression> result;
    if (const toml::array* const list = node.as_array()) {
      for (const toml::node& entry : *list) result.push_back(models_.expression(entry, names_));
      require_corners(node, result.size());
    } else {
      result.push_back(models_.expression(node, names_));
    }
    return result;
  }

  // A list per corner says how many corners the base has.
  void require_corners(const toml::node& node, std::size_t count) {
    std::uint32_t& corners = rule_.replacement.corners;
    if (count < 3 || (corners != 0 && corners != count)) {
      fail_at(node, file_, fmt::format("a list of {} for a base of {} corners", count, corners),
              "give one value per corner, and the same number in the whole rule");
    }
    corners = static_cast<std::uint32_t>(count);
  }

  std::vector<TextureAt> texture(Table& table) {
    const toml::node* const u = table.find("u");
    const toml::node* const v = table.find("v");
    if (u == nullptr && v == nullptr) return {};
    if (u == nullptr || v == nullptr)
      fail_at(table.node(), file_, "'u' needs 'v', and 'v' needs 'u'", "give both");
    const std::vector<Expression> us = per_corner(*u), vs = per_corner(*v);
    std::vector<TextureAt> result(std::max(us.size(), vs.size()));
    const std::size_t written = us.size() == 1 ? us[0].code.size() : vs.size() == 1 ? vs[0].code.size() : 0;
    if (us.size() != vs.size()) models_.count_copies(table.node(), result.size(), written);
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = {us.size() == 1 ? us[0] : us[i], vs.size() == 1 ? vs[0] : vs[i]};
    }
    return result;
  }

  Section section(const toml::node& node) {
    Table table(node, file_, "sections");
    Section result;
    if (const toml::node* const move = table.find("move")) {
      if (move->is_array()) {
        result.move = three(*move, "move");
      } else {
        result.move[2] = models_.expression(*move, names_);
      }
    }
    if (const toml::node* const turned = table.find("turn")) result.turn = three(*turned, "turn");
    const auto optional = [&](std::string_view key, Expression& to) {
      if (const toml::node* const value = table.find(key)) to = models_.expression(*value, names_);
    };
    optional("tropism", result.tropism);
    optional("scale", result.scale);
    optional("radius", result.radius);
    if (result.scale.given() && result.radius.given()) {
      fail_at(table.node(), file_, "a section has both 'scale' and 'radius'",
              "leave out one: both set its size");
    }
    if (const toml::node* const stretch = table.find("stretch")) {
      const toml::array& pair = list_of(*stretch, file_, "stretch", 2);
      result.stretch = {models_.expression(pair[0], names_), models_.expression(pair[1], names_)};
    }
    result.texture = texture(table);
    result.crease = static_cast<int>(table.integer_or("crease", 0, 0, 100));
    if (const toml::node* const sides = table.find("sides"); sides != nullptr && sides->is_array()) {
      for (const toml::node& side : *sides->as_array()) result.sides.push_back(models_.choice(side, names_));
      require_corners(*sides, result.sides.size());
    } else {
      result.sides.push_back(sides == nullptr ? SymbolChoice{} : models_.choice(*sides, names_));
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
      rule_.replacement.base_texture = texture(table);
      table.done();
    }
  }

  void mesh(const toml::node& faces) {
    Template& t = rule_.replacement;
    t.corners = static_cast<std::uint32_t>(table_.find("corners") == nullptr
                                               ? (fail_at(table_.node(), file_, "a rule without base",
                                                          "say how many 'corners' its first face has"),
                                                  0)
                                               : table_.integer_or("corners", 0, 3, 1000));
    if (const toml::node* const vertices = table_.find("vertices")) {
      for (const toml::node& v : list_of(*vertices, file_, "vertices", 0)) t.vertices.push_back(vertex(v));
    }
    t.first_corner.push_back(0);
    for (const toml::node& face : list_of(faces, file_, "faces", 0)) {
      for (const toml::node& corner : list_of(face, file_, "faces", 0)) {
        t.face_corners.push_back(models_.vertex_index(corner, "faces"));
      }
      t.first_corner.push_back(static_cast<std::uint32_t>(t.face_corners.size()));
    }
    face_symbols();
    mesh_texture();
    mesh_creases();
    check_template(t, file_, place_of(faces));
  }

  TemplateVertex vertex(const toml::node& node) {
    TemplateVertex result;
    if (node.is_array()) {
      result.offset = three(node, "vertices");
      return result;
    }
    Table table(node, file_, "vertices");
    const toml::node& mix = table.get("mix");
    for (const toml::node& weight : list_of(mix, file_, "mix", rule_.replacement.corners)) {
      result.weights.push_back(models_.expression(weight, names_));
    }
    if (const toml::node* const move = table.find("move")) result.offset = three(*move, "move");
    table.done();
    return result;
  }

  void face_symbols() {
    Template& t = rule_.replacement;
    const std::size_t faces = t.first_corner.size() - 1;
    const toml::node* const symbols = table_.find("symbols");
    if (symbols == nullptr) {
      t.faces.resize(faces);
    } else if (symbols->is_string()) {
      const SymbolChoice choice = models_.choice(*symbols, names_);
      models_.count_copies(*symbols, faces, operations_of(choice));
      t.faces.assign(faces, choice);
    } else {
      for (const toml::node& symbol : list_of(*symbols, file_, "symbols", faces)) {
        t.faces.push_back(models_.choice(symbol, names_));
      }
      if (t.faces.size() != faces) fail_at(*symbols, file_, "'symbols' needs one per face", "add faces");
    }
  }

  void mesh_texture() {
    Template& t = rule_.replacement;
    const toml::node* const node = table_.find("texture");
    if (node == nullptr) return;
    for (const toml::node& at : list_of(*node, file_, "texture", t.corners + t.vertices.size())) {
      const toml::array& pair = list_of(at, file_, "texture", 2);
      t.texture.push_back({models_.expression(pair[0], names_), models_.expression(pair[1], names_)});
    }
  }

  void mesh_creases() {
    Template& t = rule_.replacement;
    const toml::node* const node = table_.find("creases");
    if (node == nullptr) return;
    const EdgeSet edges(t.first_corner, t.face_corners);
    for (const toml::node& crease : list_of(*node, file_, "creases", 0)) {
      const toml::array& three = list_of(crease, file_, "creases", 3);
      std::uint32_t v[3];
      for (std::size_t i = 0; i < 3; ++i) v[i] = models_.vertex_index(three[i], "creases");
      if (!edges.contains(v[0], v[1]))
        fail_at(crease, file_, fmt::format("no face has an edge from {} to {}", v[0], v[1]), "name an edge");
      t.creases.push_back({v[0], v[1], static_cast<int>(std::min(v[2], 100U))});
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
  std::stable_sort(rules.begin(), rules.end(),
                   [](const Rule& a, const Rule& b) { return a.symbol < b.symbol; });
  for (std::uint32_t r = 0; r < rules.size(); ++r) {
    Symbol& symbol = models.model.system.symbols[rules[r].symbol];
    if (symbol.rules++ == 0) symbol.first_rule = r;
  }
}

}  // namespace terrabench::growing
