// §3 of "meshgrow": after finitely many steps with random displacements, standard steps follow; the limit
// surface is then known exactly, and each further mesh is four times nearer to it.
//
// A vertex with n faces moves to its limit by the eigenvalues of one vertex and its ring that belong to
// rotationally symmetric vectors: the largest below 1 is (3n - 7 + √(5n² - 30n + 49)) / 8n, which is 1/4 for
// n = 4 alone. So extraordinary vertices are recorded apart.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/cases.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

constexpr std::array<std::string_view, 3> kMeshes{"plane", "sphere", "prism"};
const std::array kSpecs{
    choice("mesh", kMeshes,
           "base mesh: all vertices regular, or extraordinary ones with 3, or 3 and 5 faces"),
    ParameterSpec{"displaced", std::int64_t{2}, "", "steps with random displacements", 0, 5},
    ParameterSpec{"steps", std::int64_t{5}, "", "standard steps after them", 2, 8},
    ParameterSpec{"amplitude", 0.15, "scale factors", "largest displacement", 0, 1},
};

std::vector<Case> cases(const RunOptions& options) {
  return cases_by("mesh", kSpecs, {{"steps", std::int64_t{options.profile == Profile::kPaper ? 6 : 5}}});
}

FaceMesh base_of(std::string_view name) {
  if (name == "plane") return growing::plane({4, 4}, 4, 4).mesh;
  return shape(name);
}

struct Distances {
  double rms = 0, largest = 0;
  std::vector<double> extraordinary;
};

Distances distances(const std::vector<glm::dvec3>& points, const std::vector<glm::dvec3>& limits,
                    const std::vector<std::uint32_t>& extraordinary) {
  Distances result;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double d = glm::length(points[v] - limits[v]);
    result.rms += d * d;
    result.largest = std::max(result.largest, d);
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(points.size()));
  for (const std::uint32_t v : extraordinary) {
    result.extraordinary.push_back(glm::length(points[v] - limits[v]));
  }
  return result;
}

double eigenvalue(double n) { return (3 * n - 7 + std::sqrt(5 * n * n - 30 * n + 49)) / (8 * n); }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  using namespace subdivision;
  PlacementRule rough;
  rough.displacements.resize(1);
  rough.displacements[0].amount = {.kind = Signal::Kind::kUniform,
                                   .amplitude = static_cast<float>(at.parameters.number("amplitude")),
                                   .seed = options.seed};
  const std::vector<PlacementRule> rules(static_cast<std::size_t>(at.integer("displaced")), rough);
  const RefinementOptions corners_stay{.boundary = Boundary::kEdgeAndCorner};
  const FaceMesh start = subdivide(base_of(at.parameters.text("mesh")), rules, corners_stay);
  const int steps = at.integer("steps");
  const Refinement refinement(start, steps, corners_stay);
  std::vector<glm::dvec3> points(start.positions.begin(), start.positions.end()), limits(points.size());
  std::vector<std::uint32_t> extraordinary;
  std::vector<double> faces_at;
  for (std::uint32_t v = 0; v < refinement.topology(0).vertices; ++v) {
    const auto uses = refinement.topology(0).uses_of(v).size();
    if (at.parameters.text("mesh") == "plane" || uses == 4)
      continue;  // all inner vertices of the plane have 4
    extraordinary.push_back(v);
    faces_at.push_back(static_cast<double>(uses));
  }
  std::vector<glm::dvec3> first_limits;
  Distances before;
  double drift = 0;
  for (int step = 0; step <= steps; ++step) {
    limits.resize(points.size());
    limit_points<glm::dvec3>(refinement.topology(step), points, limits);
    if (step == 0) first_limits = limits;
    for (std::size_t v = 0; v < first_limits.size(); ++v) {
      drift = std::max(drift, glm::length(limits[v] - first_limits[v]));
    }
    const Distances now = distances(points, limits, extraordinary);
    recorder.add(fmt::format("rms_{}", step), "m", now.rms);
    recorder.add(fmt::format("largest_{}", step), "m", now.largest);
    if (step > 0) {
      recorder.add(fmt::format("rms_ratio_{}", step), "", now.rms / before.rms);
      recorder.add(fmt::format("largest_ratio_{}", step), "", now.largest / before.largest);
    }
    if (step == steps && !extraordinary.empty()) {
      double off = 0;
      for (std::size_t k = 0; k < extraordinary.size(); ++k) {
        const double ratio = now.extraordinary[k] / before.extraordinary[k];
        recorder.add(fmt::format("ratio_at_{}_faces", faces_at[k]), "", ratio);
        off = std::max(off, std::abs(ratio - eigenvalue(faces_at[k])));
      }
      recorder.add("off_eigenvalue", "", off);
    }
    before = now;
    if (step == steps) break;
    std::vector<glm::dvec3> finer(child_vertices(refinement.topology(step)));
    place_standard<glm::dvec3>(refinement.topology(step), refinement.stencils(step), points, finer);
    points = std::move(finer);
  }
  recorder.add("limit_drift", "m", drift);
  recorder.add("vertices", "", static_cast<double>(points.size()));
}

}  // namespace

extern const Experiment kLimit{"meshgrow.limit", "§3: distances to the limit surface", kSpecs, cases,
                               measure};

}  // namespace terrabench::meshgrow
