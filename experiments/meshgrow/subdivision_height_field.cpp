// §3 of "meshgrow": displacements along one global direction give a fractal height field; along the local
// normals, the same displacements move vertices aside, and the surface folds over.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "experiments/cases.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

constexpr std::array<std::string_view, 2> kAlong{"up", "normal"};
const std::array kSpecs{
    choice("along", kAlong, "direction of the displacements: one for all vertices, or each vertex's normal"),
    ParameterSpec{"steps", std::int64_t{6}, "", "subdivisions of a plane of 4 × 4 faces", 1, 8},
    ParameterSpec{"amplitude", 0.6, "scale factors", "largest displacement", 0, 4},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("along", kSpecs); }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  using namespace subdivision;
  PlacementRule rule;
  rule.displacements.resize(1);
  rule.displacements[0].axis = at.parameters.choice("along") == 0 ? Axis::kFixed : Axis::kNormal;
  rule.displacements[0].amount = {.kind = Signal::Kind::kUniform,
                                  .amplitude = static_cast<float>(at.parameters.number("amplitude")),
                                  .seed = options.seed};
  const FaceMesh base = growing::plane({4, 4}, 4, 4).mesh;
  const auto steps = static_cast<std::size_t>(at.integer("steps"));
  const RefinementOptions corners_stay{.boundary = Boundary::kEdgeAndCorner};
  const FaceMesh flat = subdivide(base, std::vector(steps, PlacementRule{}), corners_stay);
  const FaceMesh mesh = subdivide(base, std::vector(steps, rule), corners_stay);

  double aside = 0, facing_down = 0, low = 0, high = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::vec3 &p = mesh.positions[v], &from = flat.positions[v];
    if (p.x != from.x || p.z != from.z) ++aside;
    low = std::min(low, static_cast<double>(p.y));
    high = std::max(high, static_cast<double>(p.y));
  }
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto corner = [&](std::size_t k) { return mesh.positions[mesh.corners[mesh.first_corner[f] + k]]; };
    if (glm::cross(corner(2) - corner(0), corner(3) - corner(1)).y <= 0) ++facing_down;
  }
  recorder.add("vertices", "", static_cast<double>(mesh.positions.size()));
  recorder.add("moved_aside", "", aside);
  recorder.add("faces_facing_down", "", facing_down);
  recorder.add("relief", "m", high - low);
}

}  // namespace

extern const Experiment kHeightField{"meshgrow.height-field",
                                     "§3: displacements along one direction, and along normals", kSpecs,
                                     cases, measure};

}  // namespace terrabench::meshgrow
