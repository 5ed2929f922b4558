// The same refinement by ours, by OpenSubdiv and by OpenMesh: what §7's times of expansion are compared with.
// Nothing is copied inside a timed call but what a library itself copies. Times on one thread are the
// processor's, so that other work of the machine counts as little as possible. All take turns.
#include <fmt/format.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/ompEvaluator.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "experiments/cases.h"
#include "experiments/experiment.h"
#include "experiments/meshgrow/subdivision_peer.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "terrain/memory.h"

namespace terrabench::meshgrow {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<>;
using subdivision::Refinement;
using Points = std::vector<glm::vec3>;

const std::array kSpecs{
    ParameterSpec{"levels", std::int64_t{6}, "", "refinements of the grown forking trunk", 1, 9},
};

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  for (const std::int64_t levels : {5, 6, 7}) {
    cases.push_back({fmt::format("levels={}", levels), Parameters(kSpecs, {{"levels", levels}})});
  }
  return cases;
}

// Positions of all levels, in arrays that exist.
void place_ours(const Refinement& refinement, std::vector<Points>& points) {
  for (int l = 0; l < refinement.levels(); ++l) {
    const auto at = static_cast<std::size_t>(l);
    subdivision::place_standard<glm::vec3>(refinement.topology(l), refinement.stencils(l), points[at],
                                           points[at + 1]);
  }
}

constexpr auto kBoundary = subdivision::Boundary::kEdge;

using Table = std::unique_ptr<const Far::StencilTable>;

Table table_of(const Far::TopologyRefiner& refiner) {
  Far::StencilTableFactory::Options options;
  options.generateIntermediateLevels = false;  // the finest level from the base: one pass
  options.generateOffsets = true;
  return Table(Far::StencilTableFactory::Create(refiner, options));
}

template <class Evaluator>
void evaluate(const Far::StencilTable& table, const Points& base, Points& out) {
  const Osd::BufferDescriptor vec3(0, 3, 3);
  Evaluator::EvalStencils(&base[0].x, vec3, &out[0].x, vec3, table.GetSizes().data(),
                          table.GetOffsets().data(), table.GetControlIndices().data(),
                          table.GetWeights().data(), 0, table.GetNumStencils());
}

Polygons polygons_of(const FaceMesh& base) {
  Polygons mesh;
  std::vector<Polygons::VertexHandle> handles;
  for (const glm::vec3& p : base.positions) handles.push_back(mesh.add_vertex({p.x, p.y, p.z}));
  for (std::uint32_t f = 0; f < base.faces(); ++f) {
    std::vector<Polygons::VertexHandle> face;
    for (const std::uint32_t corner : base.face(f)) face.push_back(handles[corner]);
    mesh.add_face(face);
  }
  return mesh;
}

Points points_of(const Polygons& mesh) {
  Points points;
  points.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) {
    const auto p = mesh.point(vertex);
    points.emplace_back(p[0], p[1], p[2]);
  }
  return points;
}

// Largest distance of the k-th vertices along each of three directions: 0 for the same points in any order,
// and large where any share of them lies elsewhere.
double difference(const Points& a, const Points& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (const glm::dvec3 direction :
       {glm::dvec3(0.83, 0.31, 0.46), glm::dvec3(-0.27, 0.91, 0.31), glm::dvec3(0.39, -0.44, 0.81)}) {
    const auto along = [&](const Points& points) {
      std::vector<double> sorted;
      sorted.reserve(points.size());
      for (const glm::vec3& p : points) sorted.push_back(glm::dot(glm::dvec3(p), direction));
      std::sort(sorted.begin(), sorted.end());
      return sorted;
    };
    const std::vector<double> first = along(a), second = along(b);
    for (std::size_t k = 0; k < first.size(); ++k) worst = std::max(worst, std::abs(first[k] - second[k]));
  }
  return worst;
}

// Ours, from face arrays to face arrays: on one thread, and the peak of its memory on all.
void measure_whole(const FaceMesh& base, int levels, Recorder& recorder) {
  const std::vector<subdivision::PlacementRule> rules(static_cast<std::size_t>(levels));
  Points mine, theirs;
  for (int k = 0; k < kSamples; ++k) {
    const double ours = processor_seconds([&] { mine = subdivision::subdivide(base, rules).positions; });
    Polygons mesh = polygons_of(base);
    OpenMesh::Subdivider::Uniform::CatmullClarkT<Polygons> subdivider;
    subdivider.attach(mesh);
    const double openmesh = processor_seconds([&] { subdivider(static_cast<std::size_t>(levels)); });
    subdivider.detach();
    if (k == 0) theirs = points_of(mesh);
    recorder.add("whole_time", "s", ours);
    recorder.add("openmesh_time", "s", openmesh);
    recorder.add_varying("openmesh_over_ours", "", openmesh / ours);
  }
  const std::int64_t before = HeapCounter::live();
  HeapCounter::reset_peak();
  const FaceMesh mesh = subdivision::subdivide(base, rules);
  const auto peak = static_cast<double>(HeapCounter::peak() - before);
  const auto bytes = static_cast<double>(mesh.positions.size() * sizeof(glm::vec3) + mesh.corners.size() * 4);
  recorder.add("faces", "", static_cast<double>(mesh.faces()));
  recorder.add("openmesh_difference", "m", difference(mine, theirs));
  recorder.add_varying("peak_over_mesh", "", peak / bytes);
}

// Tables apart from positions that are computed with tables that exist.
void measure_tables(const FaceMesh& base, int levels, Recorder& recorder) {
  const subdivision::RefinementOptions least{.keep = subdivision::Keep::kStencils};
  const auto refiner = opensubdiv_refiner(base, levels, kBoundary, false);
  const Table table = table_of(*refiner);
  const Refinement refinement(base, levels, least);
  std::vector<Points> points{base.positions};
  for (int l = 1; l <= levels; ++l) points.emplace_back(refinement.topology(l).vertices);
  Points theirs(static_cast<std::size_t>(table->GetNumStencils()));
  for (int k = 0; k < kSamples; ++k) {
    const double tables = processor_seconds([&] { const Refinement again(base, levels, least); });
    const double their_tables = processor_seconds(
        [&] { const Table again = table_of(*opensubdiv_refiner(base, levels, kBoundary, false)); });
    const double one = processor_seconds([&] { place_ours(refinement, points); });
    const double their_one =
        processor_seconds([&] { evaluate<Osd::CpuEvaluator>(*table, base.positions, theirs); });
    const double all = seconds([&] { place_ours(refinement, points); });
    const double their_all = seconds([&] { evaluate<Osd::OmpEvaluator>(*table, base.positions, theirs); });
    recorder.add("tables_time", "s", tables);
    recorder.add("opensubdiv_tables_time", "s", their_tables);
    recorder.add_varying("tables_over_opensubdiv", "", tables / their_tables);
    recorder.add("positions_time", "s", one);
    recorder.add("opensubdiv_positions_time", "s", their_one);
    recorder.add_varying("opensubdiv_over_ours", "", their_one / one);
    recorder.add("parallel_positions_time", "s", all);
    recorder.add("opensubdiv_parallel_positions_time", "s", their_all);
    recorder.add_varying("opensubdiv_over_ours_parallel", "", their_all / all);
  }
  recorder.add("opensubdiv_difference", "m", difference(points.back(), theirs));
}

void measure(const Case& test_case, const RunOptions&, Recorder& recorder, Progress&) {
  const growing::Model model = growing::parse_model(growing::model_text("forking_trunk"), "forking_trunk");
  const FaceMesh base = growing::expand(model, {.leave_out = {"smooth"}}).mesh;
  const int levels = test_case.integer("levels");
  measure_whole(base, levels, recorder);
  measure_tables(base, levels, recorder);
}

}  // namespace

extern const Experiment kRefinement{
    "meshgrow.refinement", "§7: the same refinement by three subdividers", kSpecs, cases, measure,
    Experiment::kTimed};

}  // namespace terrabench::meshgrow
