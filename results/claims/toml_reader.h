// Reads a claims file: every key is asked for by type, and a key that was not asked for is an error.
//
// A file may define sets and state once what holds for every member:
//
//   [sets]
//   size = ["128", "256"]
//   ground = [{name = "flat", where = "on flat land"}, {name = "hills", where = "on hills"}]
//
// A list element with each = ["ground", "size"] stands for one element per pair of members. In its texts,
// {size}, {ground} (the member's name) and {ground.where} are replaced by those of the pair. A member's
// text may take {set.field} from other fields of the same member, one level deep. A set that is a table is
// derived from another (sets.h). In a list of texts, a text with a set that no `each` names stands for one
// text per member. Numbers are not replaced.
//
// Tables, plots, pages and rankings that are stated for a set of grounds can also be made for a ground that
// the file does not name. [further] lists, per set, the members that then replace the set's own. The first
// that suits the ground is used: `measured` names a metric that the ground must have (replace_sets()).
//
//   [further]
//   ground = [
//     {name = "{further}", measured = "cavities", where = "in {further.label}"},
//     {name = "{further}", where = "on {further.label}"},
//   ]
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrain/toml.h"

namespace terrabench {

struct SetMember {
  std::map<std::string, std::string, std::less<>> fields;  // includes "name"
};

struct TomlFile {
  std::string origin;  // for error messages
  std::map<std::string, std::vector<SetMember>, std::less<>> sets;
  // Of a ground that the file does not name: what stands for it in names of cases, which can also be part of
  // a file's name, and its name, which may be a path.
  std::string ground_id = {}, ground_name = {};

  std::string named(std::string case_name) const;  // with the ground's name in place of its id
};

// A value in a file, with the set members chosen for it by the `each` of the elements around it.
struct TomlValue {
  const toml::node* node;
  const TomlFile* file;
  std::map<std::string, const SetMember*, std::less<>> bound;  // set name to member
  bool each_done = false;                                      // its own `each` has been applied

  // All of these throw bad_input with file and line. `what` names the value in the message.
  [[noreturn]] void fail(std::string_view what) const;
  std::string text(std::string_view what) const;  // with set names replaced
  std::string case_name(std::string_view what) const { return file->named(text(what)); }
  double number(std::string_view what) const;  // finite
  std::pair<TomlValue, TomlValue> pair(std::string_view what) const;
  std::vector<TomlValue> elements(std::string_view what) const;  // of a list, after `each` is applied

  TomlValue at(const toml::node& other) const { return {&other, file, bound}; }
};

// A value that is a table. Throws bad_input like TomlValue.
class TomlTable {
 public:
  explicit TomlTable(TomlValue);

  [[noreturn]] void refuse(std::string_view what) const { node_.fail(what); }
  bool has(std::string_view key) { return find(key) != nullptr; }
  TomlValue get(std::string_view key);
  std::string text(std::string_view key) { return get(key).text(key); }
  std::string text_or(std::string_view key, std::string fallback);
  bool flag(std::string_view key);                        // false when the key is absent
  std::vector<TomlValue> list(std::string_view key);      // empty when the key is absent
  std::vector<std::pair<std::string, TomlValue>> rest();  // the keys not asked for so far
  void refuse_unknown();                                  // an error if there is such a key

 private:
  const toml::table& table() const { return *node_.node->as_table(); }
  const toml::node* find(std::string_view key);

  TomlValue node_;
  std::set<std::string, std::less<>> known_;
};

// Reads the sets of a file into `sets`. Throws bad_input for an empty set or members of another form.
void read_sets(const toml::table& file, TomlFile&);

// Puts another ground in the place of those in the sets that the file's [further] names: each of these sets
// is left with one member, the first whose `measured` is a metric of the ground; a member without `measured`
// suits any ground. In the members' texts, {further} and {further.field} are those of `ground`. Throws
// bad_input for an unknown set, or if no member suits the ground.
void replace_sets(const toml::table& file, const SetMember& ground,
                  const std::function<bool(std::string_view metric)>& has, TomlFile&);

}  // namespace terrabench
