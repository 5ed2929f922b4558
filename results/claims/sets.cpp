#include "results/claims/sets.h"

#include <fmt/format.h>

#include <algorithm>

namespace terrabench {
namespace {

Sets& declared() {
  static Sets sets;
  return sets;
}

std::vector<std::string> texts(TomlTable& entry, std::string_view key) {
  std::vector<std::string> all;
  for (const TomlValue& value : entry.list(key)) all.push_back(value.text(key));
  return all;
}

std::vector<SetMember> derived(const TomlValue& node, const Sets& listed) {
  TomlTable entry(node);
  const std::string of = entry.text("of");
  const auto with = texts(entry, "with"), without = texts(entry, "without"), except = texts(entry, "except");
  entry.refuse_unknown();
  const Sets& known = listed.contains(of) ? listed : declared();
  const auto source = known.find(of);
  if (source == known.end()) entry.refuse(fmt::format("unknown set '{}'", of));
  std::vector<SetMember> members = source->second;
  for (const std::string& name : except) {
    const auto is = [&](const SetMember& member) { return member.fields.at("name") == name; };
    if (std::erase_if(members, is) == 0) entry.refuse(fmt::format("'{}' has no member '{}'", of, name));
  }
  std::erase_if(members, [&](const SetMember& member) {
    const auto has = [&](const std::string& field) { return member.fields.contains(field); };
    return !std::ranges::all_of(with, has) || std::ranges::any_of(without, has);
  });
  if (members.empty()) entry.refuse("the set is empty");
  return members;
}

}  // namespace

void declare_sets(Sets sets) { declared() = std::move(sets); }

void derive_sets(const toml::table& sets, TomlFile& file) {
  const Sets listed = file.sets;
  for (const auto& [name, node] : sets) {
    if (node.is_table()) file.sets.emplace(name.str(), derived({&node, &file, {}}, listed));
  }
}

}  // namespace terrabench
