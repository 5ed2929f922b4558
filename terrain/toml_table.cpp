#include "terrain/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "terrain/error.h"
#include "terrain/spelling.h"

namespace terrabench {

void fail_at(const toml::node& node, const std::string& file, std::string_view what,
             std::string_view advice) {
  const toml::source_position at = node.source().begin;
  throw bad_input(what, fmt::format("{}:{}:{}", file, at.line, at.column), advice);
}

double number_of(const toml::node& node, const std::string& file, std::string_view what, double lowest,
                 double highest) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (value && *value >= lowest && *value <= highest) return *value;
  fail_at(node, file,
          lowest == -1e30 && highest == 1e30
              ? fmt::format("expected a finite number in '{}'", what)
              : fmt::format("'{}' must be a number from {} to {}", what, lowest, highest),
          "write a number here");
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

namespace {

const toml::table& table_of(const toml::node& node, const std::string& file, std::string_view what) {
  if (!node.is_table()) fail_at(node, file, fmt::format("'{}' must be a table", what), "make it a table");
  return *node.as_table();
}

}  // namespace

TomlReader::TomlReader(const toml::node& node, const std::string& file, std::string_view what)
    : table_(table_of(node, file, what)), file_(file) {}

const toml::node* TomlReader::find(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

const toml::node& TomlReader::get(std::string_view key) {
  const toml::node* const node = find(key);
  if (node == nullptr) fail(missing_key(key, table_), "add it");
  return *node;
}

std::vector<std::pair<std::string, const toml::node*>> TomlReader::entries() {
  std::vector<std::pair<std::string, const toml::node*>> result;
  for (const auto& [key, value] : table_) {
    known_.emplace(key.str());
    result.emplace_back(std::string(key.str()), &value);
  }
  std::ranges::sort(result, {}, [](const auto& entry) {
    const toml::source_position at = entry.second->source().begin;
    return std::pair(at.line, at.column);
  });
  return result;
}

std::string TomlReader::text_or(std::string_view key, std::string_view otherwise) {
  const toml::node* const node = find(key);
  return node == nullptr ? std::string(otherwise) : text_of(*node, file_, key);
}

std::size_t TomlReader::word(std::string_view key, std::span<const std::string_view> words) {
  const std::string given = text(key);
  const auto found = std::ranges::find(words, given);
  if (found == words.end()) fail_at(get(key), file_, invalid_value(key, given, words), "correct it");
  return static_cast<std::size_t>(found - words.begin());
}

std::int64_t TomlReader::integer_or(std::string_view key, std::int64_t otherwise, std::int64_t least,
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

bool TomlReader::flag_or(std::string_view key, bool otherwise) {
  const toml::node* const node = find(key);
  if (node == nullptr) return otherwise;
  if (!node->is_boolean()) fail_at(*node, file_, fmt::format("'{}' must be true or false", key), "write one");
  return node->as_boolean()->get();
}

void TomlReader::done() const {
  for (const auto& [key, value] : table_) {
    if (known_.contains(key.str())) continue;
    fail_at(value, file_, unknown_key(key.str(), std::vector<std::string_view>(known_.begin(), known_.end())),
            fmt::format("known here: {}", fmt::join(known_, ", ")));
  }
}

}  // namespace terrabench
