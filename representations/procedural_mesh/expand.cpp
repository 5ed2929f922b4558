// A model's schedule, step by step. In a subdivision, the model's expressions are what displaces vertices.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

using subdivision::VertexBatch;

// Per displacement, whether a value was no finite number. Several threads set it.
using Failures = std::vector<std::atomic<bool>>;

subdivision::PlacementRule rule_of(const Model& model, const Step& step, Failures& failures) {
  subdivision::PlacementRule rule = step.placement;
  for (std::size_t d = 0; d < step.amounts.size(); ++d) {
    rule.displacements[d].amount = [&model, &amount = step.amounts[d], &failed = failures[d],
                                    key = combine(model.system.seed, d)](const VertexBatch& batch,
                                                                         std::span<float> out) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        const glm::vec3 p = batch.positions[i], n = batch.normals[i];
        const glm::vec2 t = batch.texture.empty() ? glm::vec2(0) : batch.texture[i];
        const double values[] = {p.x, p.y, p.z, t.x, t.y, n.x, n.y, n.z, batch.scales[i], batch.level * 1.0};
        static_assert(std::size(values) == std::size(kVertexNames));
        const std::uint64_t random = combine(key, (std::uint64_t{batch.level} << 32U) + batch.first + i);
        out[i] = static_cast<float>(evaluate(amount, {values, model.system.tables, random}));
        if (!std::isfinite(out[i])) failed = true;
      }
    };
  }
  return rule;
}

// After a subdivision gave each face of `before` one quadrilateral per corner, in the order of faces and
// corners: a new face keeps the symbol and the parameters of its parent; its frame is that of its own shape.
GrownMesh refined_states(const RuleSystem& system, const GrownMesh& before, FaceMesh refined) {
  GrownMesh after;
  after.steps = before.steps;
  after.parameters = before.parameters;  // the faces of one parent share them
  struct Child {
    std::uint32_t face, number, parent_state;
  };
  std::vector<Child> children;
  for (std::uint32_t f = 0, state = 0; f < before.mesh.faces(); ++f) {
    if (!system.symbols[before.mesh.symbols[f]].grows()) continue;
    const std::uint32_t first = before.mesh.first_corner[f];
    for (std::uint32_t c = first; c < before.mesh.first_corner[f + 1]; ++c) {
      children.push_back({c, c - first, state});
    }
    ++state;
  }
  after.states.resize(children.size());
  tbb::parallel_for(std::size_t{0}, children.size(), [&](std::size_t i) {
    const auto [face, number, parent_state] = children[i];
    const FaceState& parent = before.states[parent_state];
    after.states[i] = {face_shape(refined.face(face), refined.positions),
                       combine(parent.path, ~std::uint64_t{number}), parent.first_parameter};
  });
  after.mesh = std::move(refined);
  return after;
}

// One level of a subdivision step; `level` counts from 1 over the whole schedule.
GrownMesh subdivide(const Model& model, const Step& step, const GrownMesh& mesh, std::uint32_t level) {
  const auto fail = [&](Place place, std::string_view what, std::string_view advice) {
    throw bad_input(what, fmt::format("{}:{}:{}", model.system.file, place.line, place.column), advice);
  };
  // Each level has one face per corner of the level before.
  if (mesh.mesh.corners.size() > model.limits.faces) {
    fail(step.place,
         fmt::format("the subdivision gives {} faces, more than {}", mesh.mesh.corners.size(),
                     model.limits.faces),
         "subdivide less, or raise the limit of faces, to 100,000,000 at most");
  }
  Failures failures(step.amounts.size());
  const auto refuse_failures = [&] {
    for (std::size_t d = 0; d < failures.size(); ++d) {
      if (failures[d]) fail(step.amounts[d].place, kNotFinite, kKeepInRange);
    }
  };
  const subdivision::PlacementRule rule = rule_of(model, step, failures);
  FaceMesh finer;
  try {
    finer = subdivision::subdivide(mesh.mesh, {&rule, 1}, {.most_faces = model.limits.faces}, level - 1);
  } catch (const Error& error) {
    refuse_failures();
    fail(step.place, error.what(), error.advice());
  }
  refuse_failures();
  return refined_states(model.system, mesh, std::move(finer));
}

}  // namespace

GrownMesh expand(const Model& model, const ExpandOptions& options) {
  GrownMesh mesh = plant(model.system, model.base, model.arguments);
  std::uint32_t level = 0;
  const auto report = [&] {
    if (options.after_step) options.after_step(mesh, level);
  };
  report();
  for (std::size_t s = 0; s < std::min(options.most_steps, model.steps.size()); ++s) {
    const Step& step = model.steps[s];
    if (!step.name.empty() && std::ranges::count(options.leave_out, step.name) > 0) continue;
    for (std::uint32_t i = 0; i < step.levels; ++i) {
      mesh = subdivide(model, step, mesh, ++level);
      report();
    }
    if (step.levels > 0) continue;
    if (!options.after_step) {
      grow(model.system, mesh, step.growth);
      continue;
    }
    GrowOptions once = step.growth;
    once.steps = 1;
    once.to_the_end = false;
    for (std::uint32_t i = 0; step.growth.to_the_end || i < step.growth.steps; ++i) {
      if (grow(model.system, mesh, once) == 0) break;
      report();
    }
  }
  return mesh;
}

std::uint32_t leave_out_last(Model& model, std::uint32_t subdivisions) {
  while (subdivisions > 0 && !model.steps.empty() && model.steps.back().levels > 0) {
    Step& last = model.steps.back();
    const std::uint32_t fewer = std::min(last.levels, subdivisions);
    subdivisions -= fewer;
    last.levels -= fewer;
    if (last.levels == 0) model.steps.pop_back();  // it would be a growing step
  }
  return subdivisions;
}

}  // namespace terrabench::growing
