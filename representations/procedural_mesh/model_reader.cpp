#include "representations/procedural_mesh/model_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/error.h"

namespace terrabench::growing {

std::optional<std::uint32_t> ModelReader::symbol(std::string_view name) const {
  const auto found = symbol_numbers.find(name);
  return found == symbol_numbers.end() ? std::nullopt : std::optional(found->second);
}

std::uint32_t ModelReader::symbol(const toml::node& node, std::string_view what) const {
  const std::string name = text_of(node, file, what);
  const std::optional<std::uint32_t> number = symbol(name);
  if (number && *number != kNoSymbol) return *number;
  fail_at(node, file, fmt::format("unknown symbol '{}'", name), "list it in [symbols]");
}

std::string ModelReader::where(const toml::node& node) const {
  return fmt::format("{}:{}:{}", file, place_of(node).line, place_of(node).column);
}

namespace {

// The first character of a text, after its quote.
Place inside_quotes(const toml::node& node) {
  Place place = place_of(node);
  ++place.column;
  return place;
}

// "name", "name(expression, …)"
SymbolChoice::Option read_symbol(const ModelReader& models, Reader& reader) {
  const std::size_t begin = reader.position();
  SymbolChoice::Option option;
  const std::string name(reader.identifier());
  const std::optional<std::uint32_t> symbol = models.symbol(name);
  if (!symbol || name.empty()) {
    reader.go_to(begin);
    std::vector<std::string_view> known;
    for (const Symbol& s : models.model.system.symbols) known.push_back(s.name);
    reader.fail(fmt::format("unknown symbol '{}'", name), fmt::format("known: {}", fmt::join(known, ", ")));
  }
  option.symbol = *symbol;
  if (reader.take("(") && !reader.take(")")) {
    do option.arguments.push_back(reader.expression());
    while (reader.take(","));
    reader.expect(")");
  }
  const std::size_t parameters = models.model.system.symbols[*symbol].parameters.size();
  if (option.arguments.size() != parameters) {
    reader.fail(fmt::format("'{}' has {} parameters, got {}", name, parameters, option.arguments.size()),
                "give one value to each parameter");
  }
  return option;
}

// Whether a symbol stands here: a name that is no variable and no constant and is not part of an expression.
bool symbol_follows(const ModelReader& models, Reader& reader, const Names& names) {
  const std::size_t begin = reader.position();
  const std::string name(reader.identifier());
  const bool ends = reader.at_end() || reader.take(":");
  reader.go_to(begin);
  return models.symbol(name).has_value() || (!name.empty() && ends && names.find(name) == nullptr);
}

}  // namespace

Expression ModelReader::expression(const toml::node& node, const Names& names) {
  if (node.is_number()) return constant(number_of(node, file, "a value"), place_of(node));
  if (!node.is_string())
    fail_at(node, file, "expected a number or an expression", "put expressions in quotes");
  return compile(node.ref<std::string>(), file, inside_quotes(node), names, random_number);
}

SymbolChoice ModelReader::choice(const toml::node& node, const Names& names) {
  const std::string text = text_of(node, file, "a symbol");
  Reader reader(text, file, inside_quotes(node), names, random_number);
  SymbolChoice result;
  while (!symbol_follows(*this, reader, names)) {
    Expression condition = reader.condition();
    reader.expect("?");
    result.options.push_back(read_symbol(*this, reader));
    result.options.back().condition = std::move(condition);
    reader.expect(":");
  }
  result.options.push_back(read_symbol(*this, reader));
  reader.expect_end();
  return result;
}

void ModelReader::count_copies(const toml::node& node, std::size_t copies, std::size_t operations) {
  constexpr std::size_t kMostCopied = std::size_t{1} << 22U;
  // What an expression takes without any operation counts as four of them.
  copied += std::min(copies, kMostCopied + 1) * (operations + 4);
  if (copied <= kMostCopied) return;
  fail_at(node, file, "an expression that is repeated too often, or too long for that",
          "shorten the expressions, or use fewer faces");
}

std::uint32_t ModelReader::vertex_index(const toml::node& node, std::string_view what) const {
  const std::optional<std::int64_t> value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
  if (!value || *value < 0 || *value > 100'000'000) {
    fail_at(node, file, fmt::format("'{}' must be numbers of vertices, from 0", what), "correct the number");
  }
  return static_cast<std::uint32_t>(*value);
}

void ModelReader::read_faces(const toml::node& node, FaceMesh& mesh) const {
  mesh.first_corner = {0};
  for (const toml::node& face : list_of(node, file, "faces", 0)) {
    std::vector<std::uint32_t> corners;
    for (const toml::node& corner : list_of(face, file, "faces", 0)) {
      corners.push_back(vertex_index(corner, "faces"));
    }
    mesh.add_face(corners);
  }
}

std::vector<Crease> ModelReader::read_creases(const toml::node& node, const subdivision::Topology& t) const {
  std::vector<Crease> creases;
  for (const toml::node& entry : list_of(node, file, "creases", 0)) {
    const toml::array& three = list_of(entry, file, "creases", 3);
    const std::uint32_t a = vertex_index(three[0], "creases"), b = vertex_index(three[1], "creases"),
                        sharpness = vertex_index(three[2], "creases");
    if (subdivision::edge_between(t, a, b) == subdivision::kNone)
      fail_at(entry, file, fmt::format("no face has an edge from {} to {}", a, b), "name an edge");
    creases.push_back({a, b, static_cast<int>(std::min(sharpness, 100U))});
  }
  return creases;
}

}  // namespace terrabench::growing
