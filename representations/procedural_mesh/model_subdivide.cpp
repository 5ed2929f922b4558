// Subdivision steps of a model: its expressions become signals of placement rules.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "terrain/error.h"
#include "terrain/splitmix.h"

namespace terrabench::growing {
namespace {

using subdivision::VertexBatch;

// Per displacement, whether a value was no finite number. Several threads set it.
using Failures = std::vector<std::atomic<bool>>;

subdivision::Signal signal_of(const Model& model, const Displace& displace, std::uint64_t key,
                              std::atomic<bool>& failed) {
  subdivision::Signal signal;
  signal.kind = subdivision::Signal::Kind::kFunction;
  signal.function = [&model, &displace, &failed, key](const VertexBatch& batch, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const glm::vec3 p = batch.positions[i], n = batch.normals[i];
      const glm::vec2 t = batch.texture.empty() ? glm::vec2(0) : batch.texture[i];
      const double values[] = {p.x, p.y, p.z, t.x, t.y, n.x, n.y, n.z, batch.scales[i], batch.level * 1.0};
      static_assert(std::size(values) == std::size(kVertexNames));
      const std::uint64_t random = combine(key, (std::uint64_t{batch.level} << 32U) + batch.first + i);
      out[i] = static_cast<float>(evaluate(displace.amount, {values, model.system.tables, random}));
      if (!std::isfinite(out[i])) failed = true;
    }
  };
  return signal;
}

subdivision::PlacementRule rule_of(const Model& model, const Step& step, Failures& failures) {
  using subdivision::Axis;
  subdivision::PlacementRule rule;
  rule.base = step.linear ? subdivision::Base::kLinear : subdivision::Base::kStandard;
  rule.texture = step.linear_texture ? subdivision::Base::kLinear : subdivision::Base::kStandard;
  if (step.bound > 0) rule.bound = static_cast<float>(step.bound);
  for (const Displace& displace : step.displacements) {
    constexpr Axis kAxes[] = {Axis::kNormal, Axis::kTangent, Axis::kBitangent, Axis::kFixed};
    subdivision::Displacement out;
    out.axis = kAxes[static_cast<std::size_t>(displace.along)];
    out.direction = displace.direction;
    out.by_scale = displace.by_scale;
    out.where = displace.new_vertices ? subdivision::Where::kNewVertices : subdivision::Where::kEveryVertex;
    const std::size_t number = rule.displacements.size();
    out.amount = signal_of(model, displace, combine(model.system.seed, number), failures[number]);
    rule.displacements.push_back(std::move(out));
  }
  return rule;
}

std::string where(const Model& model, Place place) {
  return fmt::format("{}:{}:{}", model.system.file, place.line, place.column);
}

void refuse_failures(const Model& model, const Step& step, const Failures& failures) {
  for (std::size_t d = 0; d < failures.size(); ++d) {
    if (!failures[d]) continue;
    throw bad_input("the value is not a finite number", where(model, step.displacements[d].amount.place),
                    "check the divisors, and keep every value in its range");
  }
}

}  // namespace

GrownMesh subdivide(const Model& model, const Step& step, const GrownMesh& mesh, std::uint32_t level) {
  subdivision::RefinementOptions options;
  options.keep = step.displacements.empty() ? subdivision::Keep::kStencils : subdivision::Keep::kEverything;
  options.most_faces = model.limits.faces;
  Failures failures(step.displacements.size());
  const subdivision::PlacementRule rule = rule_of(model, step, failures);
  FaceMesh finer;
  try {
    finer = subdivision::subdivide(mesh.mesh, {&rule, 1}, options, level - 1);
  } catch (const Error& error) {
    refuse_failures(model, step, failures);
    throw bad_input(error.what(), where(model, step.place), error.advice());
  }
  refuse_failures(model, step, failures);
  return refined_states(model.system, mesh, std::move(finer));
}

}  // namespace terrabench::growing
