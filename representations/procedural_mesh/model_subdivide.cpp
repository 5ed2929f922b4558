// Subdivision steps of a model: its expressions become signals of placement rules.
#include <fmt/format.h>

#include <cmath>

#include "representations/procedural_mesh/growing/hashing.h"
#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

using subdivision::VertexBatch;

// A value that is no finite number is left to the check after displacing, which a single thread makes.
subdivision::Signal signal_of(const Model& model, const Displace& displace, std::uint64_t key) {
  subdivision::Signal signal;
  signal.kind = subdivision::Signal::Kind::kFunction;
  signal.function = [&model, &displace, key](const VertexBatch& batch, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const glm::vec3 p = batch.positions[i], n = batch.normals[i];
      const glm::vec2 t = batch.texture.empty() ? glm::vec2(0) : batch.texture[i];
      const double values[] = {p.x, p.y, p.z, t.x, t.y, n.x, n.y, n.z, batch.scales[i], batch.level * 1.0};
      static_assert(std::size(values) == std::size(kVertexNames));
      const std::uint64_t random = combine(key, (std::uint64_t{batch.level} << 32U) + batch.first + i);
      out[i] = static_cast<float>(evaluate(displace.amount, {values, model.system.tables, random}));
    }
  };
  return signal;
}

subdivision::PlacementRule rule_of(const Model& model, const Step& step) {
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
    out.amount = signal_of(model, displace, combine(model.system.seed, rule.displacements.size()));
    rule.displacements.push_back(std::move(out));
  }
  return rule;
}

}  // namespace

GrownMesh subdivide(const Model& model, const Step& step, const GrownMesh& mesh, std::uint32_t level) {
  subdivision::RefinementOptions options;
  options.keep = step.displacements.empty() ? subdivision::Keep::kStencils : subdivision::Keep::kEverything;
  options.most_faces = model.limits.faces;
  const subdivision::PlacementRule rule = rule_of(model, step);
  try {
    return refined_states(model.system, mesh,
                          subdivision::subdivide(mesh.mesh, {&rule, 1}, options, level - 1));
  } catch (const Error& error) {
    throw bad_input(error.what(),
                    fmt::format("{}:{}:{}", model.system.file, step.place.line, step.place.column),
                    error.advice());
  }
}

}  // namespace terrabench::growing
