// Reading a claims file: one table at a time, every key asked for by type, nothing left over.
//
// A file may name sets, and say once what holds for every member:
//
//   [sets]
//   size = ["128", "256"]
//   ground = [{name = "flat", where = "on flat land"}, {name = "hills", where = "on hills"}]
//
// An element of a list with each = ["ground", "size"] stands for one element a pair; {size}, {ground} (its
// name) and {ground.where} in its texts are the pair's. In a list of texts, one with a set that is not bound
// yet stands for one text a member. Numbers are not replaced.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrain/toml.h"

namespace terrabench {

struct SetMember {
  std::map<std::string, std::string, std::less<>> fields;  // "name" among them
};

struct ClaimsFile {
  std::string origin;
  std::map<std::string, std::vector<SetMember>, std::less<>> sets;
};

// A node, and what the names of sets stand for there.
struct ClaimsNode {
  const toml::node* node;
  const ClaimsFile* file;
  std::map<std::string, const SetMember*, std::less<>> bound;
  bool repeated = false;  // its `each` is done

  // All of these throw bad_input with file and line.
  [[noreturn]] void fail(std::string_view what) const;
  std::string text(std::string_view what) const;  // with the names replaced
  double number(std::string_view what) const;     // finite
  std::pair<ClaimsNode, ClaimsNode> pair(std::string_view what) const;
  std::vector<ClaimsNode> elements(std::string_view what) const;  // of a list, repeated ones in full

  ClaimsNode at(const toml::node& other) const { return {&other, file, bound}; }
};

// One table: a key that nobody asked for is an error.
class ClaimsEntry {
 public:
  explicit ClaimsEntry(ClaimsNode);

  [[noreturn]] void refuse(std::string_view what) const { node_.fail(what); }
  bool has(std::string_view key) { return find(key) != nullptr; }
  ClaimsNode get(std::string_view key);
  std::string text(std::string_view key) { return get(key).text(key); }
  std::string text_or(std::string_view key, std::string fallback);
  bool flag(std::string_view key);                         // false when the key is absent
  std::vector<ClaimsNode> list(std::string_view key);      // an empty one when the key is absent
  std::vector<std::pair<std::string, ClaimsNode>> rest();  // what nobody has asked for yet
  void refuse_unknown();

 private:
  const toml::table& table() const { return *node_.node->as_table(); }
  const toml::node* find(std::string_view key);

  ClaimsNode node_;
  std::set<std::string, std::less<>> known_;
};

// The sets of a file. Throws bad_input for one that is empty or has members of another form.
void read_sets(const toml::table& file, ClaimsFile&);

}  // namespace terrabench
