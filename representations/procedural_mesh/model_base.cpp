// The base mesh of a model: the table [base].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/model_reader.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

constexpr std::int64_t kMostCells = 1024, kMostSides = 4096;

double positive(Table& table, std::string_view key, double otherwise, const std::string& file) {
  const double value = table.number_or(key, otherwise);
  if (!(value > 0))
    fail_at(table.node(), file, fmt::format("'{}' must be above 0, got {}", key, value), "correct it");
  return value;
}

glm::dvec3 size_of(Table& table, const std::string& file) {
  const glm::dvec3 size = table.vector_or("size", glm::dvec3(1));
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
    fail_at(table.node(), file, "'size' must be above 0 along every axis", "correct it");
  }
  return size;
}

std::uint32_t count(Table& table, std::string_view key, std::int64_t otherwise, std::int64_t least,
                    std::int64_t most) {
  return static_cast<std::uint32_t>(table.integer_or(key, otherwise, least, most));
}

// One number, or one per axis.
glm::uvec3 cells_of(Table& table, const std::string& file) {
  const toml::node* const node = table.find("cells");
  if (node == nullptr || !node->is_array()) return glm::uvec3(count(table, "cells", 1, 1, 256));
  const glm::dvec3 cells = table.vector_or("cells", glm::dvec3(1));
  for (int k = 0; k < 3; ++k) {
    if (cells[k] != std::floor(cells[k]) || cells[k] < 1 || cells[k] > 256) {
      fail_at(*node, file, "'cells' must be integers from 1 to 256", "correct the value");
    }
  }
  return glm::uvec3(cells);
}

FaceMesh explicit_mesh(Table& table, const ModelReader& models) {
  FaceMesh mesh;
  const std::string& file = models.file;
  const auto number = [&](const toml::node& node) {
    return static_cast<float>(number_of(node, file, "base"));
  };
  for (const toml::node& node : list_of(table.get("vertices"), file, "vertices", 0)) {
    const toml::array& p = list_of(node, file, "vertices", 3);
    mesh.positions.emplace_back(number(p[0]), number(p[1]), number(p[2]));
  }
  mesh.first_corner.push_back(0);
  for (const toml::node& face : list_of(table.get("faces"), file, "faces", 0)) {
    for (const toml::node& corner : list_of(face, file, "faces", 0)) {
      mesh.corners.push_back(models.vertex_index(corner, "faces"));
    }
    mesh.first_corner.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  }
  if (const toml::node* const texture = table.find("texture")) {
    for (const toml::node& node : list_of(*texture, file, "texture", mesh.positions.size())) {
      const toml::array& at = list_of(node, file, "texture", 2);
      mesh.texture.emplace_back(number(at[0]), number(at[1]));
    }
  }
  mesh.texture.resize(mesh.positions.size());
  return mesh;
}

Primitive primitive(Table& table, const ModelReader& models) {
  const std::string& file = models.file;
  const std::string shape = table.text_or("shape", "mesh");
  if (shape == "plane") {
    const glm::dvec3 size = size_of(table, file);
    const std::uint32_t cells = count(table, "cells", 1, 1, kMostCells);
    return plane({size.x, size.z}, cells, cells);
  }
  if (shape == "cube") return cube(size_of(table, file), cells_of(table, file));
  if (shape == "sphere") return sphere(positive(table, "radius", 1, file), count(table, "cells", 1, 1, 256));
  if (shape == "prism") {
    const double radius = positive(table, "radius", 1, file);
    const std::uint32_t sides = count(table, "sides", 4, 3, kMostSides);
    return prism(sides, radius, positive(table, "top_radius", radius, file),
                 positive(table, "height", 1, file), count(table, "cells", 1, 1, kMostCells));
  }
  if (shape != "mesh") {
    fail_at(*table.find("shape"), file, fmt::format("unknown shape '{}'", shape),
            "known: plane, cube, sphere, prism, mesh");
  }
  Primitive result{explicit_mesh(table, models), {}};
  result.parts.assign(result.mesh.faces(), Part::kSides);
  return result;
}

void read_creases(Table& table, const ModelReader& models, FaceMesh& mesh) {
  if (const auto all = static_cast<int>(table.integer_or("crease", 0, 0, 100)); all > 0) {
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
      for (std::uint32_t c = mesh.first_corner[f]; c < mesh.first_corner[f + 1]; ++c) {
        const std::uint32_t next = c + 1 < mesh.first_corner[f + 1] ? c + 1 : mesh.first_corner[f];
        if (mesh.corners[c] < mesh.corners[next])
          mesh.creases.push_back({mesh.corners[c], mesh.corners[next], all});
      }
    }
  }
  const toml::node* const list = table.find("creases");
  if (list == nullptr) return;
  for (const toml::node& entry : list_of(*list, models.file, "creases", 0)) {
    const toml::array& crease = list_of(entry, models.file, "creases", 3);
    const std::uint32_t a = models.vertex_index(crease[0], "creases"),
                        b = models.vertex_index(crease[1], "creases");
    bool edge = false;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
      for (std::uint32_t c = mesh.first_corner[f]; c < mesh.first_corner[f + 1]; ++c) {
        const std::uint32_t next = c + 1 < mesh.first_corner[f + 1] ? c + 1 : mesh.first_corner[f];
        edge = edge || (mesh.corners[c] == a && mesh.corners[next] == b) ||
               (mesh.corners[c] == b && mesh.corners[next] == a);
      }
    }
    if (!edge)
      fail_at(entry, models.file, fmt::format("no face has an edge from {} to {}", a, b), "name an edge");
    mesh.creases.push_back(
        {a, b, static_cast<int>(std::min(models.vertex_index(crease[2], "creases"), 100U))});
  }
}

// Which symbol each face gets: the last given of "symbol", those of parts, and "symbols" of single faces.
class BaseSymbols {
 public:
  BaseSymbols(ModelReader& models, Table& table, const Primitive& base)
      : models_(models), base_(base), names_(models.constants), choices_(base.mesh.faces()) {
    names_.add_variable("side", models.file, place_of(table.node()));
    if (const toml::node* const all = table.find("symbol")) every(*all, [](Part) { return true; });
    constexpr std::pair<std::string_view, Part> kParts[] = {
        {"top", Part::kTop}, {"bottom", Part::kBottom}, {"sides_symbol", Part::kSides}};
    for (const auto& [key, part] : kParts) {
      const toml::node* const node = table.find(key);
      if (node != nullptr) every(*node, [wanted = part](Part p) { return p == wanted; });
    }
    if (const toml::node* const list = table.find("symbols")) {
      const toml::array& symbols = list_of(*list, models.file, "symbols", base.mesh.faces());
      for (std::size_t f = 0; f < choices_.size(); ++f) choices_[f] = models.choice(symbols[f], names_);
    }
  }

  void assign() {
    Model& model = models_.model;
    for (std::size_t f = 0; f < choices_.size(); ++f) {
      const double side = static_cast<double>(f);
      const Values values{{&side, 1}, names_.tables(), f};
      const auto value = [&](const Expression& e) {
        const double result = evaluate(e, values);
        if (std::isfinite(result)) return result;
        throw bad_input("the value is not a finite number",
                        fmt::format("{}:{}:{}", models_.file, e.place.line, e.place.column),
                        "divide by no zero");
      };
      for (const SymbolChoice::Option& option : choices_[f].options) {
        if (option.condition.given() && value(option.condition) == 0) continue;
        model.base.symbols[f] = option.symbol;
        for (const Expression& e : option.arguments) model.arguments[f].push_back(value(e));
        break;
      }
    }
  }

 private:
  template <class Wanted>
  void every(const toml::node& node, const Wanted& wanted) {
    const SymbolChoice choice = models_.choice(node, names_);
    for (std::size_t f = 0; f < choices_.size(); ++f) {
      if (wanted(base_.parts[f])) choices_[f] = choice;
    }
  }

  ModelReader& models_;
  const Primitive& base_;
  Names names_;
  std::vector<SymbolChoice> choices_;
};

}  // namespace

void read_base(ModelReader& models, const toml::node& node) {
  Table table(node, models.file, "base");
  Primitive base = primitive(table, models);
  if (base.mesh.faces() == 0) fail_at(node, models.file, "the base mesh has no face", "give it faces");
  const glm::vec3 centre(table.vector_or("centre", glm::dvec3(0)));
  for (glm::vec3& p : base.mesh.positions) p += centre;
  const Place place = place_of(node);
  check_base(base.mesh, fmt::format("{}:{}:{}", models.file, place.line, place.column));
  read_creases(table, models, base.mesh);
  base.mesh.symbols.assign(base.mesh.faces(), kNoSymbol);
  models.model.base = base.mesh;
  models.model.arguments.assign(base.mesh.faces(), {});
  BaseSymbols symbols(models, table, base);
  table.done();
  symbols.assign();
}

}  // namespace terrabench::growing
