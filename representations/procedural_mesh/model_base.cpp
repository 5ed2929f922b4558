// The base mesh of a model: the table [base].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/model_reader.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

constexpr std::int64_t kMostCells = 1024, kMostSides = 4096;

double positive(Table& table, std::string_view key) {
  const double value = table.number_or(key, 1);
  if (!(value > 0)) table.fail(fmt::format("'{}' must be above 0, got {}", key, value), "correct it");
  return value;
}

glm::dvec3 size_of(Table& table) {
  const glm::dvec3 size = table.vector_or("size", glm::dvec3(1));
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) {
    table.fail("'size' must be above 0 along every axis", "correct it");
  }
  return size;
}

std::uint32_t count(Table& table, std::string_view key, std::int64_t otherwise, std::int64_t least,
                    std::int64_t most) {
  return static_cast<std::uint32_t>(table.integer_or(key, otherwise, least, most));
}

// One number, or one per axis.
glm::uvec3 cells_of(Table& table) {
  const toml::node* const node = table.find("cells");
  if (node == nullptr || !node->is_array()) return glm::uvec3(count(table, "cells", 1, 1, 256));
  const auto cells = table.vector<glm::dvec3>("cells", 1, 256);
  if (cells != glm::floor(cells)) table.fail("'cells' must be integers", "correct the value");
  return glm::uvec3(cells);
}

FaceMesh explicit_mesh(Table& table, const ModelReader& models) {
  FaceMesh mesh;
  const std::string& file = models.file;
  const auto number = [&](const toml::node& node) {
    return static_cast<float>(number_of(node, file, "base"));
  };
  for (const toml::node& node : table.list("vertices")) {
    const toml::array& p = list_of(node, file, "vertices", 3);
    mesh.positions.emplace_back(number(p[0]), number(p[1]), number(p[2]));
  }
  models.read_faces(table.get("faces"), mesh);
  if (table.has("texture")) {
    for (const toml::node& node : table.list("texture", mesh.positions.size())) {
      const toml::array& at = list_of(node, file, "texture", 2);
      mesh.texture.emplace_back(number(at[0]), number(at[1]));
    }
  }
  mesh.texture.resize(mesh.positions.size());
  return mesh;
}

// Before a primitive takes memory.
void require_faces(const Table& table, const ModelReader& models, std::uint64_t faces) {
  if (faces <= models.model.limits.faces) return;
  table.fail(fmt::format("the base mesh has {} faces, more than {}", faces, models.model.limits.faces),
             "make it coarser, or raise the limit of faces, to 100,000,000 at most");
}

Primitive primitive(Table& table, const ModelReader& models) {
  constexpr std::string_view kShapes[] = {"mesh", "plane", "cube", "sphere", "prism"};
  switch (table.has("shape") ? table.word("shape", kShapes) : 0) {
    case 1: {
      const glm::dvec3 size = size_of(table);
      const std::uint32_t cells = count(table, "cells", 1, 1, kMostCells);
      require_faces(table, models, std::uint64_t{cells} * cells);
      return plane({size.x, size.z}, cells, cells);
    }
    case 2: {
      const glm::uvec3 cells = cells_of(table);
      require_faces(table, models, 2ULL * (cells.x * cells.y + cells.y * cells.z + cells.z * cells.x));
      return cube(size_of(table), cells);
    }
    case 3: {
      const std::uint32_t cells = count(table, "cells", 1, 1, 256);
      require_faces(table, models, 6ULL * cells * cells);
      return sphere(positive(table, "radius"), cells);
    }
    case 4: {
      const double radius = positive(table, "radius");
      const std::uint32_t sides = count(table, "sides", 4, 3, kMostSides);
      const std::uint32_t cells = count(table, "cells", 1, 1, kMostCells);
      require_faces(table, models, std::uint64_t{sides} * cells + 2);
      const double top = table.has("top_radius") ? positive(table, "top_radius") : radius;
      return prism(sides, radius, top, positive(table, "height"), cells);
    }
    default: {
      FaceMesh mesh = explicit_mesh(table, models);
      std::vector<Part> parts(mesh.faces(), Part::kSides);
      return {std::move(mesh), std::move(parts)};
    }
  }
}

void read_creases(Table& table, const ModelReader& models, const subdivision::Topology& topology,
                  FaceMesh& mesh) {
  if (const auto all = static_cast<int>(table.integer_or("crease", 0, 0, 100)); all > 0) {
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
        if (a < b) mesh.creases.push_back({a, b, all});
      }
    }
  }
  if (const toml::node* const list = table.find("creases")) {
    const std::vector<Crease> creases = models.read_creases(*list, topology);
    mesh.creases.insert(mesh.creases.end(), creases.begin(), creases.end());
  }
}

// Which symbol each face gets: the last given of "symbol", those of parts, and "symbols" of single faces.
class BaseSymbols {
 public:
  BaseSymbols(ModelReader& models, Table& table, const std::vector<Part>& parts)
      : models_(models), names_(&models.constants), choices_(1), choice_of_(parts.size()) {
    names_.add_variable("side", models.file, place_of(table.node()));
    const auto every = [&](std::string_view key, const auto& wanted) {
      const toml::node* const node = table.find(key);
      if (node == nullptr) return;
      const auto number = static_cast<std::uint32_t>(choices_.size());
      choices_.push_back(models_.choice(*node, names_));
      for (std::size_t f = 0; f < parts.size(); ++f) {
        if (wanted(parts[f])) choice_of_[f] = number;
      }
    };
    every("symbol", [](Part) { return true; });
    every("top", [](Part part) { return part == Part::kTop; });
    every("bottom", [](Part part) { return part == Part::kBottom; });
    every("sides_symbol", [](Part part) { return part == Part::kSides; });
    if (!table.has("symbols")) return;
    const toml::array& symbols = table.list("symbols", parts.size());
    for (std::size_t f = 0; f < choice_of_.size(); ++f) {
      choice_of_[f] = static_cast<std::uint32_t>(choices_.size());
      choices_.push_back(models.choice(symbols[f], names_));
    }
  }

  void assign() {
    Model& model = models_.model;
    for (const std::uint32_t choice : choice_of_) count_work(choices_[choice]);
    for (std::size_t f = 0; f < choice_of_.size(); ++f) {
      const double side = static_cast<double>(f);
      const Values values{{&side, 1}, names_.tables(), f};
      const auto value = [&](const Expression& e) {
        const double result = evaluate(e, values);
        if (std::isfinite(result)) return result;
        throw bad_input(kNotFinite, fmt::format("{}:{}:{}", models_.file, e.place.line, e.place.column),
                        kKeepInRange);
      };
      for (const SymbolChoice::Option& option : choices_[choice_of_[f]].options) {
        if (option.condition.given() && value(option.condition) == 0) continue;
        model.base.symbols[f] = option.symbol;
        for (const Expression& e : option.arguments) model.arguments[f].push_back(value(e));
        break;
      }
    }
  }

 private:
  // Evaluating long expressions for very many faces must end in seconds.
  void count_work(const SymbolChoice& choice) {
    constexpr std::uint64_t kMostWork = std::uint64_t{1} << 29U;
    for (const SymbolChoice::Option& option : choice.options) {
      work_ += 1 + option.condition.code.size();
      for (const Expression& e : option.arguments) work_ += 1 + e.code.size();
      parameters_ += option.arguments.size();  // at most
    }
    if (work_ <= kMostWork && parameters_ <= models_.model.limits.elements()) return;
    throw bad_input("the expressions of the base's symbols are too long for so many faces", models_.file,
                    "shorten them, or use fewer faces");
  }

  ModelReader& models_;
  Names names_;
  std::vector<SymbolChoice> choices_;     // the first: no symbol
  std::vector<std::uint32_t> choice_of_;  // per face, in choices_
  std::uint64_t work_ = 0, parameters_ = 0;
};

}  // namespace

void read_base(ModelReader& models, const toml::node& node) {
  Table table(node, models.file, "base");
  auto [mesh, parts] = primitive(table, models);
  if (mesh.faces() == 0) table.fail("the base mesh has no face", "give it faces");
  const glm::vec3 centre(table.vector_or("centre", glm::dvec3(0)));
  for (glm::vec3& p : mesh.positions) p += centre;
  read_creases(table, models, check_base(mesh, models.where(node)), mesh);
  mesh.symbols.assign(mesh.faces(), kNoSymbol);
  models.model.base = std::move(mesh);
  models.model.arguments.assign(parts.size(), {});
  BaseSymbols symbols(models, table, parts);
  table.done();
  symbols.assign();
}

}  // namespace terrabench::growing
