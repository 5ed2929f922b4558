#include "representations/procedural_mesh/model_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"
#include "terrain/spelling.h"

namespace terrabench::growing {

void fail_at(const toml::node& node, const std::string& file, std::string_view what,
             std::string_view advice) {
  const Place place = place_of(node);
  throw bad_input(what, fmt::format("{}:{}:{}", file, place.line, place.column), advice);
}

Table::Table(const toml::node& node, const std::string& file, std::string_view what)
    : table_([&]() -> const toml::table& {
        if (!node.is_table())
          fail_at(node, file, fmt::format("'{}' must be a table", what), "see docs/models.md");
        return *node.as_table();
      }()),
      file_(file) {}

const toml::node* Table::find(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

const toml::node& Table::get(std::string_view key) {
  const toml::node* const node = find(key);
  if (node == nullptr) fail_at(table_, file_, missing_key(key, table_), "add it");
  return *node;
}

std::vector<std::pair<std::string, const toml::node*>> Table::entries() {
  std::vector<std::pair<std::string, const toml::node*>> result;
  for (const auto& [key, value] : table_) {
    known_.emplace(key.str());
    result.emplace_back(std::string(key.str()), &value);
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    const Place first = place_of(*a.second), second = place_of(*b.second);
    return std::pair(first.line, first.column) < std::pair(second.line, second.column);
  });
  return result;
}

std::string Table::text_or(std::string_view key, std::string_view otherwise) {
  const toml::node* const node = find(key);
  return node == nullptr ? std::string(otherwise) : text_of(*node, file_, key);
}

double Table::number_or(std::string_view key, double otherwise) {
  const toml::node* const node = find(key);
  return node == nullptr ? otherwise : number_of(*node, file_, key);
}

std::int64_t Table::integer_or(std::string_view key, std::int64_t otherwise, std::int64_t least,
                               std::int64_t most) {
  const toml::node* const node = find(key);
  if (node == nullptr) return otherwise;
  const std::optional<std::int64_t> value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > most) {
    fail_at(*node, file_, fmt::format("'{}' must be an integer from {} to {}", key, least, most),
            "correct the value");
  }
  return *value;
}

bool Table::flag_or(std::string_view key, bool otherwise) {
  const toml::node* const node = find(key);
  if (node == nullptr) return otherwise;
  if (!node->is_boolean()) fail_at(*node, file_, fmt::format("'{}' must be true or false", key), "write one");
  return node->as_boolean()->get();
}

glm::dvec3 Table::vector_or(std::string_view key, glm::dvec3 otherwise) {
  const toml::node* const node = find(key);
  if (node == nullptr) return otherwise;
  const toml::array& list = list_of(*node, file_, key, 3);
  return {number_of(list[0], file_, key), number_of(list[1], file_, key), number_of(list[2], file_, key)};
}

void Table::done() const {
  for (const auto& [key, value] : table_) {
    if (known_.contains(key.str())) continue;
    fail_at(value, file_, unknown_key(key.str(), std::vector<std::string_view>(known_.begin(), known_.end())),
            fmt::format("known here: {}", fmt::join(known_, ", ")));
  }
}

double number_of(const toml::node& node, const std::string& file, std::string_view what) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value) || std::abs(*value) > 1e30) {
    fail_at(node, file, fmt::format("expected a finite number in '{}'", what), "write a number here");
  }
  return *value;
}

std::string text_of(const toml::node& node, const std::string& file, std::string_view what) {
  if (!node.is_string()) fail_at(node, file, fmt::format("'{}' must be text", what), "put it in quotes");
  return node.ref<std::string>();
}

const toml::array& list_of(const toml::node& node, const std::string& file, std::string_view what,
                           std::size_t size) {
  const toml::array* const list = node.as_array();
  if (list == nullptr || (size > 0 && list->size() != size)) {
    fail_at(node, file,
            size > 0 ? fmt::format("'{}' must be a list of {}", what, size)
                     : fmt::format("'{}' must be a list", what),
            "write it in square brackets");
  }
  return *list;
}

EdgeSet::EdgeSet(std::span<const std::uint32_t> first_corner, std::span<const std::uint32_t> corners) {
  edges_.reserve(corners.size());
  for (std::size_t f = 0; f + 1 < first_corner.size(); ++f) {
    const std::uint32_t first = first_corner[f], last = first_corner[f + 1];
    for (std::uint32_t c = first; c < last; ++c) {
      edges_.push_back(std::minmax({corners[c], corners[c + 1 < last ? c + 1 : first]}));
    }
  }
  std::sort(edges_.begin(), edges_.end());
}

bool EdgeSet::contains(std::uint32_t a, std::uint32_t b) const {
  const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax({a, b});
  return std::binary_search(edges_.begin(), edges_.end(), edge);
}

std::optional<std::uint32_t> ModelReader::symbol(std::string_view name) const {
  const auto found = symbol_numbers.find(name);
  return found == symbol_numbers.end() ? std::nullopt : std::optional(found->second);
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

}  // namespace terrabench::growing
