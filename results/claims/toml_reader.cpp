#include "results/claims/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "results/claims/sets.h"
#include "terrain/error.h"
#include "terrain/spelling.h"

namespace terrabench {
namespace {

constexpr std::string_view kEach = "each", kName = "name", kFurther = "further", kMeasured = "measured";
constexpr std::size_t kMostElements = 4096;  // of a list, after `each` is applied

// "{set}" or "{set.field}" in a text.
struct Slot {
  std::size_t begin, end;
  std::string_view set, field;
};

std::optional<Slot> next_slot(std::string_view text, std::size_t from) {
  const std::size_t begin = text.find('{', from);
  const std::size_t end = begin == text.npos ? begin : text.find('}', begin);
  if (end == text.npos) return std::nullopt;
  const std::string_view inside = text.substr(begin + 1, end - begin - 1);
  const std::size_t dot = inside.find('.');
  return Slot{begin, end + 1, inside.substr(0, dot), dot == inside.npos ? kName : inside.substr(dot + 1)};
}

const std::vector<SetMember>& set_of(const TomlValue& at, std::string_view name) {
  const auto set = at.file->sets.find(name);
  if (set == at.file->sets.end()) at.fail(fmt::format("unknown set '{}'", name));
  return set->second;
}

std::vector<TomlValue> for_each_member(const std::vector<TomlValue>& nodes, std::string_view set) {
  std::vector<TomlValue> all;
  for (const TomlValue& node : nodes) {
    if (node.bound.contains(set)) node.fail(fmt::format("'each' names the set '{}' twice", set));
    for (const SetMember& member : set_of(node, set)) {
      all.push_back(node);
      all.back().bound[std::string(set)] = &member;
    }
  }
  if (all.size() > kMostElements)
    nodes.front().fail(fmt::format("a list has more than {} elements", kMostElements));
  return all;
}

std::vector<TomlValue> repeated(const TomlValue& node) {
  std::vector<TomlValue> all{node};
  if (const toml::table* const table = node.node->as_table()) {
    const toml::node* const each = table->get(kEach);
    if (each == nullptr) return all;
    all.front().each_done = true;
    for (const TomlValue& name : node.at(*each).elements(kEach)) {
      all = for_each_member(all, name.text(kEach));
    }
  } else if (node.node->is_string()) {
    const std::string& text = node.node->ref<std::string>();
    for (auto slot = next_slot(text, 0); slot; slot = next_slot(text, slot->end)) {
      if (!all.front().bound.contains(slot->set)) all = for_each_member(all, slot->set);
    }
  }
  return all;
}

bool has_slot(const TomlValue& value) {
  return value.node->is_string() && next_slot(value.node->ref<std::string>(), 0);
}

// Texts with slots are read last, since they name the others.
SetMember member_from(TomlValue element, const std::string& set) {
  SetMember member;
  if (element.node->is_string()) {
    member.fields.emplace(kName, element.text(set));
    return member;
  }
  element.bound[set] = &member;
  TomlTable entry(std::move(element));
  member.fields.emplace(kName, entry.text(kName));
  std::map<std::string, std::string> named;
  const auto rest = entry.rest();
  for (const auto& [key, value] : rest) {
    if (!has_slot(value)) member.fields.emplace(key, value.text(key));
  }
  for (const auto& [key, value] : rest) {
    if (has_slot(value)) named.emplace(key, value.text(key));
  }
  member.fields.merge(named);
  return member;
}

}  // namespace

std::string TomlFile::named(std::string case_name) const {
  if (!ground_id.empty() && (case_name == ground_id || case_name.starts_with(ground_id + "/")))
    case_name.replace(0, ground_id.size(), ground_name);
  return case_name;
}

void TomlValue::fail(std::string_view what) const {
  throw bad_input(what, fmt::format("{}:{}", file->origin, node->source().begin.line),
                  "correct the claims file");
}

std::string TomlValue::text(std::string_view what) const {
  if (!node->is_string()) fail(fmt::format("'{}' is not text", what));
  const std::string& raw = node->ref<std::string>();
  std::string full;
  std::size_t done = 0;
  for (auto slot = next_slot(raw, 0); slot; slot = next_slot(raw, slot->end)) {
    const auto member = bound.find(slot->set);
    if (member == bound.end()) fail(fmt::format("no 'each' names the set '{}' here", slot->set));
    const auto field = member->second->fields.find(slot->field);
    if (field == member->second->fields.end()) {
      fail(fmt::format("a member of '{}' has no '{}', or that field refers to other fields itself", slot->set,
                       slot->field));
    }
    full.append(raw, done, slot->begin - done).append(field->second);
    done = slot->end;
  }
  return full.append(raw, done);
}

double TomlValue::number(std::string_view what) const {
  const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !std::isfinite(*value)) fail(fmt::format("'{}' is not a finite number", what));
  return *value;
}

std::pair<TomlValue, TomlValue> TomlValue::pair(std::string_view what) const {
  const toml::array* const array = node->as_array();
  if (array == nullptr || array->size() != 2) fail(fmt::format("'{}' is not a pair", what));
  return {at(*array->get(0)), at(*array->get(1))};
}

std::vector<TomlValue> TomlValue::elements(std::string_view what) const {
  const toml::array* const array = node->as_array();
  if (array == nullptr) fail(fmt::format("'{}' is not a list", what));
  std::vector<TomlValue> all;
  for (const toml::node& element : *array) {
    for (TomlValue& one : repeated(at(element))) all.push_back(std::move(one));
  }
  return all;
}

TomlTable::TomlTable(TomlValue node) : node_(std::move(node)) {
  if (!node_.node->is_table()) refuse("a table is expected here");
  if (node_.each_done) known_.insert(std::string(kEach));
}

const toml::node* TomlTable::find(std::string_view key) {
  known_.insert(std::string(key));
  return table().get(key);
}

TomlValue TomlTable::get(std::string_view key) {
  const toml::node* const node = find(key);
  if (node == nullptr) refuse(missing_key(key, table()));
  return node_.at(*node);
}

std::string TomlTable::text_or(std::string_view key, std::string fallback) {
  return has(key) ? text(key) : std::move(fallback);
}

bool TomlTable::flag(std::string_view key) {
  const toml::node* const node = find(key);
  if (node != nullptr && !node->is_boolean()) refuse(fmt::format("'{}' must be true or false", key));
  return node != nullptr && node->ref<bool>();
}

std::vector<TomlValue> TomlTable::list(std::string_view key) {
  if (!has(key)) return {};
  return get(key).elements(key);
}

std::vector<std::pair<std::string, TomlValue>> TomlTable::rest() {
  std::vector<std::pair<std::string, TomlValue>> others;
  for (const auto& [key, value] : table()) {
    if (!known_.contains(key.str())) others.emplace_back(key.str(), node_.at(value));
  }
  for (const auto& [key, value] : others) known_.insert(key);
  return others;
}

void TomlTable::refuse_unknown() {
  const std::vector<std::string> known(known_.begin(), known_.end());  // before rest(), which adds to it
  for (const auto& [key, node] : rest()) {
    node.fail(unknown_key(key, std::vector<std::string_view>(known.begin(), known.end())));
  }
}

void read_sets(const toml::table& table, TomlFile& file) {
  const toml::node* const sets = table.get("sets");
  if (sets == nullptr) return;
  for (const auto& [name, node] : TomlTable({sets, &file, {}}).rest()) {
    if (node.node->is_table()) continue;  // derived from those listed
    std::vector<SetMember> members;
    for (const TomlValue& element : node.elements(name)) members.push_back(member_from(element, name));
    if (members.empty()) node.fail(fmt::format("the set '{}' is empty", name));
    file.sets.emplace(name, std::move(members));
  }
  derive_sets(*sets->as_table(), file);
}

void replace_sets(const toml::table& table, const SetMember& ground,
                  const std::function<bool(std::string_view metric)>& has, TomlFile& file) {
  const toml::node* const further = table.get(kFurther);
  if (further == nullptr) return;
  const TomlValue value{further, &file, {{std::string(kFurther), &ground}}};
  for (const auto& [name, node] : TomlTable(value).rest()) {
    const auto set = file.sets.find(name);
    if (set == file.sets.end()) node.fail(fmt::format("unknown set '{}'", name));
    std::vector<SetMember> members;
    for (const TomlValue& element : node.elements(name)) members.push_back(member_from(element, name));
    const auto suits = [&](const SetMember& member) {
      const auto measured = member.fields.find(kMeasured);
      return measured == member.fields.end() || has(measured->second);
    };
    const auto chosen = std::ranges::find_if(members, suits);
    if (chosen == members.end()) node.fail(fmt::format("no member of '{}' suits this ground", name));
    set->second = {*chosen};
  }
}

}  // namespace terrabench
