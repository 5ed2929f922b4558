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

// Before a primitive takes memory.
void require_faces(const Table& table, const ModelReader& models, std::uint64_t faces) {
  if (faces <= models.model.limits.faces) return;
  fail_at(table.node(), models.file,
          fmt::format("the base mesh has {} faces, more than {}", faces, models.model.limits.faces),
          "make it coarser, or raise the limit of faces, to 100,000,000 at most");
}

Primitive primitive(Table& table, const ModelReader& models) {
  const std::string& file = models.file;
  const std::string shape = table.text_or("shape", "mesh");
  if (shape == "plane") {
    const glm::dvec3 size = size_of(table, file);
    const std::uint32_t cells = count(table, "cells", 1, 1, kMostCells);
    require_faces(table, models, std::uint64_t{cells} * cells);
    return plane({size.x, size.z}, cells, cells);
  }
  if (shape == "cube") {
    const glm::uvec3 cells = cells_of(table, file);
    require_faces(table, models, 2ULL * (cells.x * cells.y + cells.y * cells.z + cells.z * cells.x));
    return cube(size_of(table, file), cells);
  }
  if (shape == "sphere") {
    const std::uint32_t cells = count(table, "cells", 1, 1, 256);
    require_faces(table, models, 6ULL * cells * cells);
    return sphere(positive(table, "radius", 1, file), cells);
  }
  if (shape == "prism") {
    const double radius = positive(table, "radius", 1, file);
    const std::uint32_t sides = count(table, "sides", 4, 3, kMostSides);
    const std::uint32_t cells = count(table, "cells", 1, 1, kMostCells);
    require_faces(table, models, std::uint64_t{sides} * cells + 2);
    return prism(sides, radius, positive(table, "top_radius", radius, file),
                 positive(table, "height", 1, file), cells);
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
  const EdgeSet edges(mesh.first_corner, mesh.corners);
  for (const toml::node& entry : list_of(*list, models.file, "creases", 0)) {
    const toml::array& crease = list_of(entry, models.file, "creases", 3);
    const std::uint32_t a = models.vertex_index(crease[0], "creases"),
                        b = models.vertex_index(crease[1], "creases");
    if (!edges.contains(a, b))
      fail_at(entry, models.file, fmt::format("no face has an edge from {} to {}", a, b), "name an edge");
    mesh.creases.push_back(
        {a, b, static_cast<int>(std::min(models.vertex_index(crease[2], "creases"), 100U))});
  }
}

// Which symbol each face gets: the last given of "symbol", those of parts, and "symbols" of single faces.
class BaseSymbols {
 public:
  BaseSymbols(ModelReader& models, Table& table, const Primitive& base)
      : models_(models), base_(base), names_(&models.constants), choices_(1), choice_of_(base.mesh.faces()) {
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
      for (std::size_t f = 0; f < choice_of_.size(); ++f) {
        choice_of_[f] = static_cast<std::uint32_t>(choices_.size());
        choices_.push_back(models.choice(symbols[f], names_));
      }
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
        throw bad_input("the value is not a finite number",
                        fmt::format("{}:{}:{}", models_.file, e.place.line, e.place.column),
                        "check the divisors");
      };
      const SymbolChoice& choice = choices_[choice_of_[f]];
      for (const SymbolChoice::Option& option : choice.options) {
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

  template <class Wanted>
  void every(const toml::node& node, const Wanted& wanted) {
    const auto number = static_cast<std::uint32_t>(choices_.size());
    choices_.push_back(models_.choice(node, names_));
    for (std::size_t f = 0; f < choice_of_.size(); ++f) {
      if (wanted(base_.parts[f])) choice_of_[f] = number;
    }
  }

  ModelReader& models_;
  const Primitive& base_;
  Names names_;
  std::vector<SymbolChoice> choices_;     // the first: no symbol
  std::vector<std::uint32_t> choice_of_;  // per face, in choices_
  std::uint64_t work_ = 0, parameters_ = 0;
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
