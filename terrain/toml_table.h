// Reads TOML by type: a value of another type, a missing key and one that was not asked for are errors with
// file, line and column. All functions throw bad_input. Include this header only in .cpp files (toml.h).
#pragma once

#include <glm/vec3.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrain/toml.h"

namespace terrabench {

[[noreturn]] void fail_at(const toml::node&, const std::string& file, std::string_view what,
                          std::string_view advice);

// `what` names the value in messages.
double number_of(const toml::node&, const std::string& file, std::string_view what, double lowest = -1e30,
                 double highest = 1e30);
std::string text_of(const toml::node&, const std::string& file, std::string_view what);
// Of this number of entries; 0: of any.
const toml::array& list_of(const toml::node&, const std::string& file, std::string_view what,
                           std::size_t size);
// "'hieght' is missing", "unknown key 'hieght'" and the like suggest the key that was probably meant.
class TomlReader {
 public:
  // The node and the file's name must outlive it.
  TomlReader(const toml::node& node, const std::string& file, std::string_view what);

  [[noreturn]] void fail(std::string_view what, std::string_view advice = "correct the file") const {
    fail_at(table_, file_, what, advice);
  }
  const toml::node& node() const { return table_; }
  const toml::node* find(std::string_view key);  // null when the key is absent
  bool has(std::string_view key) { return find(key) != nullptr; }
  const toml::node& get(std::string_view key);
  // In the order of the file. All keys count as asked for.
  std::vector<std::pair<std::string, const toml::node*>> entries();

  std::string text(std::string_view key) { return text_of(get(key), file_, key); }
  std::string text_or(std::string_view key, std::string_view otherwise);
  std::size_t word(std::string_view key, std::span<const std::string_view> words);  // its index
  double number(std::string_view key, double lowest = -1e30, double highest = 1e30) {
    return number_of(get(key), file_, key, lowest, highest);
  }
  double number_or(std::string_view key, double otherwise, double lowest = -1e30, double highest = 1e30) {
    return find(key) == nullptr ? otherwise : number(key, lowest, highest);
  }
  std::int64_t integer_or(std::string_view key, std::int64_t otherwise, std::int64_t least,
                          std::int64_t most);
  bool flag_or(std::string_view key, bool otherwise);
  const toml::array& list(std::string_view key, std::size_t size = 0) {
    return list_of(get(key), file_, key, size);
  }
  template <class Vector>
  Vector vector(std::string_view key, double lowest = -1e30, double highest = 1e30) {
    Vector all;
    const toml::array& numbers = list(key, static_cast<std::size_t>(all.length()));
    for (int k = 0; k < all.length(); ++k) {
      all[k] = number_of(numbers[static_cast<std::size_t>(k)], file_, key, lowest, highest);
    }
    return all;
  }
  glm::dvec3 vector_or(std::string_view key, const glm::dvec3& otherwise) {
    return find(key) == nullptr ? otherwise : vector<glm::dvec3>(key);
  }
  void done() const;  // throws for a key that was not asked for

 private:
  const toml::table& table_;
  const std::string& file_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace terrabench
