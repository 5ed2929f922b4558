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
#include "representations/procedural_mesh/subdivision/subdivide.h"

namespace terrabench::meshgrow {
namespace {

const std::array kSpecs{choice("shape", kShapes, "mesh that is refined"),
                        ParameterSpec{"levels", std::int64_t{4}, "", "refinements", 1, 8}};

std::vector<Case> cases(const RunOptions&) { return cases_by("shape", kSpecs); }

template <class Points>
std::vector<glm::dvec3> in_double(const Points& points) {
  return {points.begin(), points.end()};
}

// Against one other construction, over all levels.
struct Worst {
  std::size_t mismatches = 0;
  double single = 0, in_double = 0;  // largest distances, as shares of the base mesh's diagonal
  void record(Recorder& recorder, std::string_view prefix) const {
    recorder.add(fmt::format("{}mismatches", prefix), "", static_cast<double>(mismatches));
    recorder.add(fmt::format("{}difference", prefix), "", single);
    recorder.add(fmt::format("{}difference_in_double", prefix), "", in_double);
  }
};

double farthest(const std::vector<glm::dvec3>& points, const PeerLevel& peer) {
  double worst = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    worst = std::max(worst, glm::distance(points[v], peer.points[peer.ours[v]]));
  }
  return worst;
}

// Vertex for vertex, at every level and for both rules for corners of a boundary; the plain reference, which
// knows no creases, has the first.
void measure(const Case& test_case, const RunOptions&, Recorder& recorder, Progress&) {
  using namespace subdivision;
  const FaceMesh base = shape(test_case.parameters.text("shape"));
  const int levels = test_case.integer("levels");
  const double diagonal = glm::length(box_of(base.positions).size());
  Worst opensubdiv, textbook;
  for (const Boundary boundary : {Boundary::kEdge, Boundary::kEdgeAndCorner}) {
    const Refinement refinement(base, levels, {boundary});
    const std::vector<PeerLevel> peers = opensubdiv_levels(base, refinement, boundary);
    const std::vector<std::vector<glm::dvec3>> doubles =
        standard_points(refinement, in_double(base.positions));
    LevelPoints single{base.positions, {}};
    PlainMesh reference = plain(base);
    const bool plain_too = boundary == Boundary::kEdge && !has_creases(base);
    for (int level = 1; level <= levels; ++level) {
      const auto l = static_cast<std::size_t>(level);
      single = next_points(refinement, level - 1, single, PlacementRule{}, 0);
      const std::vector<glm::dvec3> singles = in_double(single.positions);
      if (l < peers.size()) opensubdiv.mismatches += peers[l].mismatches;
      if (l < peers.size() && !peers[l].ours.empty()) {
        opensubdiv.single = std::max(opensubdiv.single, farthest(singles, peers[l]) / diagonal);
        opensubdiv.in_double = std::max(opensubdiv.in_double, farthest(doubles[l], peers[l]) / diagonal);
      }
      if (!plain_too) continue;
      reference = catmull_clark(reference);
      const std::vector<std::uint32_t>& quads = refinement.topology(level).corners;
      const Comparison by_single = compare(quads, singles, reference),
                       by_double = compare(quads, doubles[l], reference);
      textbook.single = std::max(textbook.single, by_single.largest);
      textbook.in_double = std::max(textbook.in_double, by_double.largest);
      textbook.mismatches += by_single.mismatches + by_double.mismatches;
    }
    if (plain_too) textbook.record(recorder, "");
    if (boundary == Boundary::kEdge) recorder.add("vertices", "", static_cast<double>(doubles.back().size()));
  }
  opensubdiv.record(recorder, "opensubdiv_");
}

}  // namespace

extern const Experiment kStandard{"meshgrow.standard",
                                  "§3: the standard rule beside OpenSubdiv and textbook Catmull–Clark",
                                  kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
