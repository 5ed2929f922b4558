#include "experiments/meshgrow/growing_steps.h"

#include <algorithm>
#include <map>
#include <optional>

#include "terrain/error.h"

namespace terrabench::meshgrow {

using namespace growing;

std::span<const std::uint32_t> corners_of(const FaceMesh& mesh, std::uint32_t face) {
  return {mesh.corners.data() + mesh.first_corner[face], mesh.corners.data() + mesh.first_corner[face + 1]};
}

GrownMesh expand_in_steps(const Model& model, const AtStep& visit) {
  GrownMesh mesh = plant(model.system, model.base, model.arguments);
  visit(mesh, mesh, 0);
  int subdivisions = 0;
  for (const Step& step : model.steps) {
    if (step.levels > 0) {
      for (std::uint32_t k = 0; k < step.levels; ++k) {
        GrownMesh finer = subdivide(model, step, mesh, static_cast<std::uint32_t>(++subdivisions));
        visit(mesh, finer, subdivisions);
        mesh = std::move(finer);
      }
      continue;
    }
    GrowOptions once = step.growth;
    once.steps = 1;
    once.to_the_end = false;
    for (std::uint32_t k = 0; step.growth.to_the_end || k < step.growth.steps; ++k) {
      const GrownMesh before = mesh;
      if (grow(model.system, mesh, once) == 0) break;  // which counts as a step in expand(), too
      visit(before, mesh, subdivisions);
    }
  }
  return mesh;
}

namespace {

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
    for (const std::uint32_t vertex : corners_of(before.mesh, f)) faces_at[vertex].push_back(f);
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

}  // namespace

Fork find_fork(const Model& model, std::string_view symbol) {
  std::optional<Fork> fork;
  expand_in_steps(model, [&](const GrownMesh& before, const GrownMesh& after, int subdivisions) {
    if (fork || subdivisions > 0 || after.steps == 0) return;
    fork = fork_in(model.system, before, after, symbol);
  });
  if (!fork) {
    throw bad_input("no two growing faces share a vertex", model.system.file, "give the model a fork");
  }
  return *std::move(fork);
}

}  // namespace terrabench::meshgrow
