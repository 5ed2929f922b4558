// The same refinement by ours, by OpenSubdiv and by OpenMesh: what §7's times of expansion are compared with.
#include <fmt/format.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <array>
#include <glm/geometric.hpp>
#include <memory>

#include "experiments/cases.h"
#include "experiments/experiment.h"
#include "experiments/meshgrow/growing_steps.h"
#include "experiments/stopwatch.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<>;

constexpr std::array<std::string_view, 3> kSubdividers{"ours", "opensubdiv", "openmesh"};
const std::array kSpecs{
    choice("subdivider", kSubdividers, "that refines the grown forking trunk"),
    ParameterSpec{"levels", std::int64_t{6}, "", "refinements", 1, 9},
    ParameterSpec{"runs", std::int64_t{5}, "", "refinements that are timed", 1, 1000},
};

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  return cases_by("subdivider", kSpecs,
                  {{"levels", std::int64_t{paper ? 7 : 6}}, {"runs", std::int64_t{paper ? 9 : 5}}});
}

// What a subdivider returns: its vertices in its own order, and its faces.
struct Result {
  std::vector<glm::vec3> positions;
  std::size_t faces = 0;
};

Result refine_ours(const FaceMesh& base, int levels) {
  const std::vector<subdivision::PlacementRule> rules(static_cast<std::size_t>(levels));
  subdivision::RefinementOptions options;
  options.keep = subdivision::Keep::kStencils;
  FaceMesh mesh = subdivision::subdivide(base, rules, options);
  return {std::move(mesh.positions), mesh.faces()};
}

struct Point {
  glm::vec3 at{0};
  void Clear() { at = glm::vec3(0); }
  void AddWithWeight(const Point& p, float w) { at += p.at * w; }
};

Result refine_opensubdiv(const FaceMesh& base, int levels) {
  std::vector<int> sizes, corners(base.corners.begin(), base.corners.end());
  for (std::uint32_t f = 0; f < base.faces(); ++f) {
    sizes.push_back(static_cast<int>(corners_of(base, f).size()));
  }
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(base.positions.size());
  d.numFaces = static_cast<int>(sizes.size());
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = corners.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(d, Factory::Options(Sdc::SCHEME_CATMARK, options)));
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  const Far::PrimvarRefiner primvar(*refiner);
  std::vector<Point> points(base.positions.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v].at = base.positions[v];
  for (int level = 1; level <= levels; ++level) {
    std::vector<Point> finer(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
    primvar.Interpolate(level, points, finer);
    points = std::move(finer);
  }
  Result result;
  result.faces = static_cast<std::size_t>(refiner->GetLevel(levels).GetNumFaces());
  for (const Point& point : points) result.positions.push_back(point.at);
  return result;
}

Result refine_openmesh(const FaceMesh& base, int levels) {
  Polygons mesh;
  std::vector<Polygons::VertexHandle> handles;
  for (const glm::vec3& p : base.positions) handles.push_back(mesh.add_vertex({p.x, p.y, p.z}));
  for (std::uint32_t f = 0; f < base.faces(); ++f) {
    std::vector<Polygons::VertexHandle> face;
    for (const std::uint32_t corner : corners_of(base, f)) face.push_back(handles[corner]);
    mesh.add_face(face);
  }
  OpenMesh::Subdivider::Uniform::CatmullClarkT<Polygons> subdivider;
  subdivider.attach(mesh);
  subdivider(static_cast<std::size_t>(levels));
  subdivider.detach();
  Result result;
  result.faces = mesh.n_faces();
  for (const auto vertex : mesh.vertices()) {
    const auto p = mesh.point(vertex);
    result.positions.emplace_back(p[0], p[1], p[2]);
  }
  return result;
}

glm::dvec3 mean_of(const Result& result) {
  glm::dvec3 sum(0);
  for (const glm::vec3& p : result.positions) sum += glm::dvec3(p);
  return sum / static_cast<double>(result.positions.size());
}

void measure(const Case& at, const RunOptions&, Recorder& recorder, Progress&) {
  using Refine = Result (*)(const FaceMesh&, int);
  constexpr std::array<Refine, kSubdividers.size()> kRefine{refine_ours, refine_opensubdiv, refine_openmesh};
  const growing::Model model = growing::parse_model(growing::model_text("forking_trunk"), "forking_trunk");
  growing::ExpandOptions growth;
  growth.leave_out = {"smooth"};
  const FaceMesh base = growing::expand(model, growth).mesh;
  const int levels = at.integer("levels");
  Result result;
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < at.integer("runs"); ++run) {
    const double time = seconds([&] { result = kRefine[at.parameters.choice("subdivider")](base, levels); });
    recorder.add("time", "s", time);
    best = std::min(best, time);
  }
  const auto triangles = 2 * static_cast<double>(result.faces);
  recorder.add("best_time", "s", best);
  recorder.add("triangles", "", triangles);
  recorder.add("vertices", "", static_cast<double>(result.positions.size()));
  recorder.add("triangles_per_second", "1/s", triangles / best);
  // The vertices' mean does not depend on their order.
  recorder.add("mean_distance_to_ours", "m",
               glm::distance(mean_of(result), mean_of(refine_ours(base, levels))));
}

}  // namespace

extern const Experiment kRefinement{"meshgrow.refinement", "§7: the same refinement by three subdividers",
                                    kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
