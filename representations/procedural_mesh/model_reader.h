// Reads the TOML of a model by type, with line and column in every error. Only for the model_*.cpp files.
#pragma once

#include <map>
#include <optional>
#include <set>

#include "representations/procedural_mesh/model.h"
#include "terrain/toml.h"

namespace terrabench::growing {

inline Place place_of(const toml::node& node) {
  return {node.source().begin.line, node.source().begin.column};
}
[[noreturn]] void fail_at(const toml::node&, const std::string& file, std::string_view what,
                          std::string_view advice);

// The keys of one table. What was not asked for is refused by done().
class Table {
 public:
  Table(const toml::node& node, const std::string& file, std::string_view what);

  const toml::node* find(std::string_view key);
  const toml::node& get(std::string_view key);
  const toml::node& node() const { return table_; }
  // In the order of the file. All keys count as known.
  std::vector<std::pair<std::string, const toml::node*>> entries();

  std::string text_or(std::string_view key, std::string_view otherwise);
  double number_or(std::string_view key, double otherwise);
  std::int64_t integer_or(std::string_view key, std::int64_t otherwise, std::int64_t least,
                          std::int64_t most);
  bool flag_or(std::string_view key, bool otherwise);
  glm::dvec3 vector_or(std::string_view key, glm::dvec3 otherwise);
  void done() const;  // throws for a key that was not asked for

 private:
  const toml::table& table_;
  const std::string& file_;
  std::set<std::string, std::less<>> known_;
};

double number_of(const toml::node&, const std::string& file, std::string_view what);
std::string text_of(const toml::node&, const std::string& file, std::string_view what);
// Throws unless it is a list with this number of entries; 0: any number.
const toml::array& list_of(const toml::node&, const std::string& file, std::string_view what,
                           std::size_t size);

// The edges of polygons: sorted once, O(log corners) for each question.
class EdgeSet {
 public:
  EdgeSet(std::span<const std::uint32_t> first_corner, std::span<const std::uint32_t> corners);
  bool contains(std::uint32_t a, std::uint32_t b) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  // the lower vertex first
};

// What the parts of a model share while it is read.
struct ModelReader {
  Model& model;
  const std::string& file;
  Names constants{};
  std::uint32_t random_number = 0;
  std::map<std::string, std::uint32_t, std::less<>> symbol_numbers{};
  std::size_t copied = 0;  // operations of expressions that are stored more often than they are written

  std::optional<std::uint32_t> symbol(std::string_view name) const;
  Expression expression(const toml::node&, const Names&);  // a number, or a text
  SymbolChoice choice(const toml::node&, const Names&);    // a text
  std::uint32_t vertex_index(const toml::node&, std::string_view what) const;
  // Throws where a model's copies of expressions would take more than some 64 MiB in all.
  void count_copies(const toml::node&, std::size_t copies, std::size_t operations);
};

// model_rules.cpp, model_base.cpp, model_steps.cpp
void read_rules(ModelReader&, const toml::node*);
void read_base(ModelReader&, const toml::node&);
void read_steps(ModelReader&, const toml::node*);

}  // namespace terrabench::growing
