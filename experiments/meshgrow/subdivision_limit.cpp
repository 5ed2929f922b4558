// §3 of "meshgrow": after finitely many steps with random displacements, standard steps follow; the limit
// surface is then known exactly, and each further mesh is nearer to it. How much nearer depends on the
// vertex, so the classes of vertices are recorded apart, by their number of faces:
//  - a vertex that is followed through all steps approaches its limit by the largest eigenvalue below 1 of
//  its
//    ring's subdivision matrix that belongs to rotationally symmetric vectors: 1/4 for 4 faces alone;
//  - its neighbours, which are other vertices at each step, slide along the surface by the subdominant
//    eigenvalue, except beside regular vertices, where the limit reproduces linear functions at every vertex.
// The eigenvalues come from the matrix itself (ring_eigenvalue.h), which shares no code with the library.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "experiments/cases.h"
#include "experiments/meshgrow/ring_eigenvalue.h"
#include "experiments/meshgrow/root_mean_square.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

using subdivision::Topology;

constexpr std::array<std::string_view, 3> kMeshes{"plane", "sphere", "prism"};
const std::array kSpecs{
    choice("mesh", kMeshes,
           "base mesh: all vertices regular, or extraordinary ones with 3, or 3 and 5 faces"),
    ParameterSpec{"displaced", std::int64_t{2}, "", "steps with random displacements", 0, 5},
    ParameterSpec{"steps", std::int64_t{6}, "", "standard steps after them", 2, 8},
    ParameterSpec{"amplitude", 0.15, "scale factors", "largest displacement", 0, 1},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("mesh", kSpecs); }

FaceMesh base_of(std::string_view name) {
  if (name == "plane") return growing::plane({4, 4}, 4, 4).mesh;
  return shape(name);
}

struct Distances {
  double rms = 0, largest = 0;
  std::map<std::size_t, double> vertices, rings;  // root mean square by the number of faces
};

// `followed`: the number of faces at each vertex of the first mesh, 0 for those at the boundary.
Distances distances(const Topology& t, const std::vector<glm::dvec3>& points,
                    const std::vector<glm::dvec3>& limits, const std::vector<std::size_t>& followed) {
  Distances result;
  const auto distance = [&](std::size_t v) { return glm::length(points[v] - limits[v]); };
  RootMeanSquare all;
  for (std::size_t v = 0; v < points.size(); ++v) {
    all.add(distance(v));
    result.largest = std::max(result.largest, distance(v));
  }
  result.rms = all.value();
  std::map<std::size_t, RootMeanSquare> vertices, rings;
  for (std::uint32_t v = 0; v < followed.size(); ++v) {
    if (followed[v] == 0) continue;
    vertices[followed[v]].add(distance(v));
    for (const std::uint32_t c : t.uses_of(v)) {  // all faces are quadrilaterals
      rings[followed[v]].add(distance(t.corners[c % 4 == 3 ? c - 3 : c + 1]));
    }
  }
  for (const auto& [n, d] : vertices) result.vertices[n] = d.value();
  for (const auto& [n, d] : rings) result.rings[n] = d.value();
  return result;
}

void record_step(Recorder& recorder, int step, int last, const Distances& now, const Distances& before) {
  recorder.add(fmt::format("rms_{}", step), "m", now.rms);
  recorder.add(fmt::format("largest_{}", step), "m", now.largest);
  if (step == 0) return;
  recorder.add(fmt::format("rms_ratio_{}", step), "", now.rms / before.rms);
  recorder.add(fmt::format("largest_ratio_{}", step), "", now.largest / before.largest);
  for (const auto& [n, d] : now.vertices) {
    const double vertex = d / before.vertices.at(n), ring = now.rings.at(n) / before.rings.at(n);
    recorder.add(fmt::format("vertex_{}_ratio_{}", n, step), "", vertex);
    recorder.add(fmt::format("ring_{}_ratio_{}", n, step), "", ring);
    if (step != last) continue;
    const double symmetric = ring_eigenvalue(n, 0), subdominant = n == 4 ? 0.25 : ring_eigenvalue(n, 1);
    recorder.add(fmt::format("vertex_{}_eigenvalue", n), "", symmetric);
    recorder.add(fmt::format("ring_{}_eigenvalue", n), "", subdominant);
    recorder.add(fmt::format("vertex_{}_off_eigenvalue", n), "", std::abs(vertex - symmetric));
    recorder.add(fmt::format("ring_{}_off_eigenvalue", n), "", std::abs(ring - subdominant));
  }
}

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
  std::vector<std::size_t> followed;
  for (std::uint32_t v = 0; v < refinement.topology(0).vertices; ++v) {
    const std::size_t faces = refinement.topology(0).uses_of(v).size();
    // All inner vertices of the plane have 4 faces. Without a displaced step, the prism has pentagons.
    const bool inner = at.parameters.text("mesh") != "plane" || faces == 4;
    followed.push_back(inner && !rules.empty() ? faces : 0);
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
    Distances now = distances(refinement.topology(step), points, limits, followed);
    record_step(recorder, step, steps, now, before);
    before = std::move(now);
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
