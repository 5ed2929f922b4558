// §3 of "meshgrow": the standard placement rule is Catmull–Clark's, vertex for vertex: beside OpenSubdiv on
// all shapes, and beside a plain reference on those without creases.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "experiments/cases.h"
#include "experiments/meshgrow/subdivision_peer.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

const std::array kSpecs{choice("shape", kShapes, "mesh that is refined"),
                        ParameterSpec{"levels", std::int64_t{4}, "", "refinements", 1, 8}};

std::vector<Case> cases(const RunOptions&) { return cases_by("shape", kSpecs); }

template <class Points>
std::vector<glm::dvec3> in_double(const Points& points) {
  return {points.begin(), points.end()};
}

double diagonal_of(const FaceMesh& mesh) {
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::distance(low, high);
}

struct Worst {
  std::size_t mismatches = 0;
  double single = 0, in_double = 0;  // largest distances, as shares of the base mesh's diagonal
};

double farthest(const std::vector<glm::dvec3>& points, const PeerLevel& peer) {
  double worst = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    worst = std::max(worst, glm::distance(points[v], peer.points[peer.ours[v]]));
  }
  return worst;
}

// Vertex for vertex, at every level and for one of the two rules for corners of a boundary.
Worst beside_opensubdiv(const FaceMesh& base, int levels, subdivision::Boundary boundary) {
  using namespace subdivision;
  const Refinement refinement(base, levels, {boundary});
  const std::vector<PeerLevel> peers = opensubdiv_levels(base, refinement, boundary);
  std::vector<glm::dvec3> points = in_double(base.positions);
  const double diagonal = diagonal_of(base);
  Worst worst;
  for (int level = 1; level <= levels; ++level) {
    if (static_cast<std::size_t>(level) >= peers.size()) break;
    const PeerLevel& peer = peers[static_cast<std::size_t>(level)];
    worst.mismatches += peer.mismatches;
    if (peer.ours.empty()) break;
    const std::vector<PlacementRule> rules(static_cast<std::size_t>(level));
    const FaceMesh refined = subdivide(base, rules, {boundary});
    std::vector<glm::dvec3> finer(child_vertices(refinement.topology(level - 1)));
    place_standard<glm::dvec3>(refinement.topology(level - 1), refinement.stencils(level - 1), points, finer);
    points = std::move(finer);
    worst.single = std::max(worst.single, farthest(in_double(refined.positions), peer) / diagonal);
    worst.in_double = std::max(worst.in_double, farthest(points, peer) / diagonal);
  }
  return worst;
}

// Beside the plain reference, which knows no creases.
void beside_textbook(const FaceMesh& base, int levels, Recorder& recorder) {
  using namespace subdivision;
  const Refinement refinement(base, levels);
  PlainMesh reference = plain(base);
  std::vector<glm::dvec3> points = in_double(base.positions);
  Worst worst;
  for (int level = 1; level <= levels; ++level) {
    reference = catmull_clark(reference);
    // The whole step as models take it, in single precision, and its stencils in double precision.
    const std::vector<PlacementRule> rules(static_cast<std::size_t>(level));
    const FaceMesh refined = subdivide(base, rules);
    std::vector<glm::dvec3> finer(child_vertices(refinement.topology(level - 1)));
    place_standard<glm::dvec3>(refinement.topology(level - 1), refinement.stencils(level - 1), points, finer);
    points = std::move(finer);
    const Comparison single = compare(refined.corners, in_double(refined.positions), reference),
                     doubles = compare(refinement.topology(level).corners, points, reference);
    recorder.add(fmt::format("difference_level_{}", level), "", single.largest);
    worst.single = std::max(worst.single, single.largest);
    worst.in_double = std::max(worst.in_double, doubles.largest);
    worst.mismatches += single.mismatches + doubles.mismatches;
  }
  recorder.add("mismatches", "", static_cast<double>(worst.mismatches));
  recorder.add("difference", "", worst.single);
  recorder.add("difference_in_double", "", worst.in_double);
}

void measure(const Case& at, const RunOptions&, Recorder& recorder, Progress&) {
  using subdivision::Boundary;
  const FaceMesh base = shape(at.parameters.text("shape"));
  const int levels = at.integer("levels");
  const Worst edge = beside_opensubdiv(base, levels, Boundary::kEdge),
              corner = beside_opensubdiv(base, levels, Boundary::kEdgeAndCorner);
  recorder.add("opensubdiv_mismatches", "", static_cast<double>(edge.mismatches + corner.mismatches));
  recorder.add("opensubdiv_difference", "", std::max(edge.single, corner.single));
  recorder.add("opensubdiv_difference_in_double", "", std::max(edge.in_double, corner.in_double));
  const subdivision::Refinement refinement(base, levels);
  recorder.add("vertices", "", static_cast<double>(refinement.topology(levels).vertices));
  recorder.add("faces", "", static_cast<double>(refinement.topology(levels).faces()));
  if (!has_creases(base)) beside_textbook(base, levels, recorder);
}

}  // namespace

extern const Experiment kStandard{"meshgrow.standard",
                                  "§3: the standard rule beside OpenSubdiv and textbook Catmull–Clark",
                                  kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
