#include "experiments/meshgrow/fork.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>

#include "terrain/error.h"

namespace terrabench::meshgrow {

using namespace growing;

namespace {

// Calls visit(before, after) for every growing step before the first subdivision.
template <class Visit>
void each_growing_step(const Model& model, const Visit& visit) {
  GrownMesh before;
  expand(model, {.after_step = [&](const GrownMesh& after, std::uint32_t subdivisions) {
           if (subdivisions > 0) return;
           if (after.steps > 0) visit(before, after);
           before = after;
         }});
}

// One step in which, of the given faces, only one grows; the others lose their symbols.
GrownMesh grown_alone(const RuleSystem& system, const GrownMesh& before,
                      const std::vector<std::uint32_t>& faces, std::uint32_t alone) {
  GrownMesh mesh = before;
  std::vector<FaceState> states;
  std::size_t state = 0;
  for (std::uint32_t f = 0; f < mesh.mesh.faces(); ++f) {
    if (!system.symbols[mesh.mesh.symbols[f]].grows()) continue;
    const FaceState& kept = before.states[state++];
    if (f != alone && std::find(faces.begin(), faces.end(), f) != faces.end()) {
      mesh.mesh.symbols[f] = kNoSymbol;
    } else {
      states.push_back(kept);
    }
  }
  mesh.states = std::move(states);
  grow(system, mesh, {});
  return mesh;
}

std::optional<Fork> fork_in(const RuleSystem& system, const GrownMesh& before, const GrownMesh& after,
                            std::string_view symbol) {
  Fork fork;
  std::map<std::uint32_t, std::vector<std::uint32_t>> faces_at;
  for (std::uint32_t f = 0; f < before.mesh.faces(); ++f) {
    if (system.symbols[before.mesh.symbols[f]].name != symbol) continue;
    fork.faces.push_back(f);
    for (const std::uint32_t vertex : before.mesh.face(f)) faces_at[vertex].push_back(f);
  }
  for (const auto& [vertex, faces] : faces_at) {
    if (faces.size() == 2) {
      Fork::Shared shared{vertex, {}, static_cast<double>(after.mesh.texture[vertex].x)};
      for (std::size_t k = 0; k < 2; ++k) {
        const GrownMesh alone = grown_alone(system, before, fork.faces, faces[k]);
        shared.alone[k] = static_cast<double>(alone.mesh.texture[vertex].x);
      }
      std::sort(shared.alone.begin(), shared.alone.end());
      fork.shared.push_back(shared);
    } else if (faces.size() == 1) {
      ++fork.others;
      if (before.mesh.texture[vertex].x != after.mesh.texture[vertex].x) ++fork.others_changed;
    }
  }
  if (fork.shared.empty()) return std::nullopt;
  std::sort(fork.shared.begin(), fork.shared.end(), [](const auto& a, const auto& b) { return a.u < b.u; });
  fork.before = before;
  fork.after = after;
  return fork;
}

bool has_face(const FaceMesh& mesh, std::span<const std::uint32_t> corners) {
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    if (std::ranges::equal(mesh.face(face), corners)) return true;
  }
  return false;
}

// The middle of these corners and their mean v.
std::pair<glm::dvec3, double> middle_of(const FaceMesh& mesh, std::span<const std::uint32_t> corners) {
  glm::dvec3 place(0);
  double v = 0;
  for (const std::uint32_t vertex : corners) {
    place += glm::dvec3(mesh.positions[vertex]) / static_cast<double>(corners.size());
    v += static_cast<double>(mesh.texture[vertex].y) / static_cast<double>(corners.size());
  }
  return {place, v};
}

}  // namespace

std::vector<StemSection> sections_along(const Model& model, std::span<const std::string_view> symbols) {
  const auto symbol_of = [&](const FaceMesh& mesh, std::uint32_t face) {
    const auto at = std::find(symbols.begin(), symbols.end(), model.system.symbols[mesh.symbols[face]].name);
    return at == symbols.end() ? std::string_view() : *at;
  };
  std::vector<StemSection> sections;
  each_growing_step(model, [&](const GrownMesh& before, const GrownMesh& after) {
    for (std::uint32_t from = 0; from < before.mesh.faces(); ++from) {
      const std::string_view symbol = symbol_of(before.mesh, from);
      const auto base = before.mesh.face(from);
      if (symbol.empty() || has_face(after.mesh, base)) continue;
      const auto [start, v] = middle_of(after.mesh, base);
      StemSection section{symbol, std::numeric_limits<double>::infinity(), v, 0};
      for (std::uint32_t to = 0; to < after.mesh.faces(); ++to) {
        const auto corners = after.mesh.face(to);
        const bool is_cap = std::all_of(corners.begin(), corners.end(), [&](std::uint32_t vertex) {
          return vertex >= before.mesh.positions.size();
        });
        if (!is_cap || symbol_of(after.mesh, to).empty()) continue;
        const auto [end, end_v] = middle_of(after.mesh, corners);
        if (glm::distance(start, end) >= section.length) continue;
        section.length = glm::distance(start, end);
        section.end_v = end_v;
      }
      if (std::isfinite(section.length)) sections.push_back(section);
    }
  });
  return sections;
}

Fork find_fork(const Model& model, std::string_view symbol) {
  std::optional<Fork> fork;
  each_growing_step(model, [&](const GrownMesh& before, const GrownMesh& after) {
    if (!fork) fork = fork_in(model.system, before, after, symbol);
  });
  if (!fork) {
    throw bad_input("no two growing faces share a vertex", model.system.file, "give the model a fork");
  }
  return *std::move(fork);
}

}  // namespace terrabench::meshgrow
