#include "representations/procedural_mesh/growing/grow.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/procedural_mesh/growing/expansion.h"
#include "representations/procedural_mesh/growing/wave.h"
#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

// The growing faces with their states, which lie in the same order.
std::vector<Active> growing_faces(const RuleSystem& system, const GrownMesh& grown) {
  std::vector<Active> active;
  active.reserve(grown.states.size());
  for (std::uint32_t f = 0; f < grown.mesh.faces(); ++f) {
    const Symbol& symbol = system.symbols[grown.mesh.symbols[f]];
    if (!symbol.grows()) continue;
    active.push_back(
        {f, static_cast<std::uint32_t>(active.size()), static_cast<std::uint32_t>(symbol.parameters.size())});
  }
  return active;
}

}  // namespace

GrownMesh plant(const RuleSystem& system, FaceMesh mesh, const std::vector<std::vector<double>>& arguments) {
  GrownMesh grown;
  mesh.texture.resize(mesh.positions.size());
  mesh.symbols.resize(mesh.faces());
  for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
    if (!system.symbols[mesh.symbols[f]].grows()) continue;
    const std::span<const std::uint32_t> corners(mesh.corners.data() + mesh.first_corner[f],
                                                 mesh.corners.data() + mesh.first_corner[f + 1]);
    FaceState state;
    state.shape = face_shape(corners, mesh.positions);
    state.path = scramble(f);
    state.first_parameter = static_cast<std::uint32_t>(grown.parameters.size());
    if (!(state.shape.area > 0)) {
      throw bad_input(fmt::format("face {} of the base mesh is degenerate", f), system.file,
                      "move its corners");
    }
    grown.parameters.insert(grown.parameters.end(), arguments[f].begin(), arguments[f].end());
    grown.states.push_back(state);
  }
  grown.mesh = std::move(mesh);
  return grown;
}

std::size_t grow(const RuleSystem& system, GrownMesh& grown, const GrowOptions& options) {
  std::vector<Active> active, resting;
  for (const Active& face : growing_faces(system, grown)) {
    const std::uint32_t symbol = grown.mesh.symbols[face.face];
    (options.only.empty() || options.only[symbol] ? active : resting).push_back(face);
  }
  Wave wave(system, grown, options);
  std::size_t expanded = 0;
  for (std::uint32_t step = 0; (options.to_the_end || step < options.steps) && !active.empty(); ++step) {
    if (grown.steps >= options.limits.steps) {
      throw bad_input(fmt::format("the model still grows after {} steps", options.limits.steps), system.file,
                      "add a condition that ends its growth, or raise the limit of steps");
    }
    expanded += wave.run(active, resting);
    ++grown.steps;
    if (wave.should_drop()) wave.drop_replaced({&active, &resting});
  }
  resting.insert(resting.end(), active.begin(), active.end());
  std::sort(resting.begin(), resting.end(), [](const Active& a, const Active& b) { return a.face < b.face; });
  wave.drop_replaced({&resting});
  return expanded;
}

GrownMesh refined_states(const RuleSystem& system, const GrownMesh& before, FaceMesh refined) {
  GrownMesh after;
  after.steps = before.steps;
  const std::size_t faces = before.mesh.faces();
  const bool label = refined.symbols.empty();
  if (label) refined.symbols.resize(refined.faces());
  struct Parent {
    std::uint32_t state, first, count, parameters;
  };
  std::vector<Parent> parents;
  for (std::uint32_t f = 0, state = 0; f < faces; ++f) {
    const std::uint32_t first = before.mesh.first_corner[f], last = before.mesh.first_corner[f + 1];
    const std::uint32_t symbol = before.mesh.symbols[f];
    if (label) std::fill(refined.symbols.begin() + first, refined.symbols.begin() + last, symbol);
    if (!system.symbols[symbol].grows()) continue;
    const auto parameters = static_cast<std::uint32_t>(system.symbols[symbol].parameters.size());
    parents.push_back({state++, first, last - first, parameters});
  }
  after.parameters = before.parameters;  // the faces of one parent share them
  std::vector<std::size_t> offsets;
  std::size_t states = 0;
  for (const Parent& parent : parents) {
    offsets.push_back(states);
    states += parent.count;
  }
  after.states.resize(states);
  tbb::parallel_for(std::size_t{0}, parents.size(), [&](std::size_t i) {
    const FaceState& old = before.states[parents[i].state];
    for (std::uint32_t c = 0; c < parents[i].count; ++c) {
      const std::uint32_t f = parents[i].first + c;
      const std::span<const std::uint32_t> corners(refined.corners.data() + refined.first_corner[f],
                                                   refined.corners.data() + refined.first_corner[f + 1]);
      after.states[offsets[i] + c] = {face_shape(corners, refined.positions),
                                      combine(old.path, ~std::uint64_t{c}), old.first_parameter};
    }
  });
  refined.texture.resize(refined.positions.size());
  after.mesh = std::move(refined);
  return after;
}

}  // namespace terrabench::growing
