// §3 of "meshgrow": the standard placement rule is Catmull–Clark's, vertex for vertex.
#include <fmt/format.h>

#include <array>

#include "experiments/cases.h"
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

void measure(const Case& at, const RunOptions&, Recorder& recorder, Progress&) {
  using namespace subdivision;
  const FaceMesh base = shape(at.parameters.text("shape"));
  const int levels = at.integer("levels");
  const Refinement refinement(base, levels);
  PlainMesh reference = plain(base);
  std::vector<glm::dvec3> points = in_double(base.positions);
  double in_single = 0, in_doubles = 0;
  std::size_t mismatches = 0;
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
    in_single = std::max(in_single, single.largest);
    in_doubles = std::max(in_doubles, doubles.largest);
    mismatches += single.mismatches + doubles.mismatches;
  }
  recorder.add("mismatches", "", static_cast<double>(mismatches));
  recorder.add("difference", "", in_single);
  recorder.add("difference_in_double", "", in_doubles);
  recorder.add("vertices", "", static_cast<double>(reference.points.size()));
  recorder.add("faces", "", static_cast<double>(reference.faces.size()));
}

}  // namespace

extern const Experiment kStandard{"meshgrow.standard", "§3: the standard rule beside textbook Catmull–Clark",
                                  kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
