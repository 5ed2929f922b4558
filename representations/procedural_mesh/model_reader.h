// What the readers of a model's parts share. Only for the model*.cpp files.
#pragma once

#include <map>
#include <optional>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/topology.h"
#include "terrain/toml_table.h"

namespace terrabench::growing {

using Table = TomlReader;

inline Place place_of(const toml::node& node) {
  return {node.source().begin.line, node.source().begin.column};
}

// What the parts of a model share while it is read.
struct ModelReader {
  Model& model;
  const std::string& file;
  Names constants{};
  std::uint32_t random_number = 0;
  std::map<std::string, std::uint32_t, std::less<>> symbol_numbers{};
  std::size_t copied = 0;  // operations of expressions that are stored more often than they are written

  std::optional<std::uint32_t> symbol(std::string_view name) const;
  std::uint32_t symbol(const toml::node&, std::string_view what) const;  // by its name; not "none"
  Expression expression(const toml::node&, const Names&);                // a number, or a text
  SymbolChoice choice(const toml::node&, const Names&);                  // a text
  std::uint32_t vertex_index(const toml::node&, std::string_view what) const;
  // "faces": the vertices of each.
  void read_faces(const toml::node&, FaceMesh&) const;
  // "creases": [from, to, sharpness], of edges that there must be.
  std::vector<Crease> read_creases(const toml::node&, const subdivision::Topology&) const;
  // Throws where a model's copies of expressions would take more than some 64 MiB in all.
  void count_copies(const toml::node&, std::size_t copies, std::size_t operations);
  std::string where(const toml::node&) const;
};

// model_rules.cpp, model_base.cpp, model_steps.cpp
void read_rules(ModelReader&, const toml::node*);
void read_base(ModelReader&, const toml::node&);
void read_steps(ModelReader&, const toml::node*);

}  // namespace terrabench::growing
