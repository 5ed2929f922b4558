// §4, §6 and §7 of "meshgrow": whether every mesh on the way is well formed, bytes of the models and of their
// meshes, time of the expansion; and the texture coordinates at a fork (§5, figure 9).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "experiments/cases.h"
#include "experiments/experiment.h"
#include "experiments/meshgrow/fork.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/procedural_mesh/mesh_checks.h"

namespace terrabench::meshgrow {
namespace {

using namespace growing;

struct Drawn {
  std::string_view name;
  bool open = false;  // whether the surface is meant to have a boundary
};
constexpr auto kDrawn = std::to_array<Drawn>({{"fractal_plane", true},
                                              {"fractal_sphere"},
                                              {"forking_trunk"},
                                              {"fork_ridges"},
                                              {"fork_ridges_random"},
                                              {"chair"},
                                              {"cactus"},
                                              {"cactus_smooth"},
                                              {"branch_aspen"},
                                              {"bush_tupelo"},
                                              {"candle_holder"}});
constexpr std::array kNames = names_of(kDrawn);
const std::array kSpecs{choice("model", kNames, "model of the paper")};

std::vector<Case> cases(const RunOptions&) { return cases_by("model", kSpecs); }

Model read_model(const Case& test_case) {
  const std::string& name = test_case.parameters.text("model");
  return parse_model(model_text(name), name);
}

double bytes_of(const FaceMesh& mesh) {
  return static_cast<double>(mesh.positions.size() * sizeof(glm::vec3) +
                             mesh.texture.size() * sizeof(glm::vec2) +
                             (mesh.corners.size() + mesh.first_corner.size()) * sizeof(std::uint32_t));
}

// A vertex in the middle of an edge of one face alone: what the checks must find.
FaceMesh with_t_vertex(FaceMesh mesh, std::size_t face) {
  const std::size_t corner = mesh.first_corner[face];
  const glm::vec3 a = mesh.positions[mesh.corners[corner]], b = mesh.positions[mesh.corners[corner + 1]];
  mesh.corners.insert(mesh.corners.begin() + static_cast<std::ptrdiff_t>(corner) + 1,
                      static_cast<std::uint32_t>(mesh.positions.size()));
  mesh.positions.push_back(0.5F * (a + b));
  if (!mesh.texture.empty()) mesh.texture.emplace_back(0);
  for (std::size_t f = face + 1; f < mesh.first_corner.size(); ++f) ++mesh.first_corner[f];
  return mesh;
}

// One face per decade of the length of its first edge, the middle one of each, whose first edge has two
// faces.
std::vector<std::size_t> face_of_each_decade(const FaceMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) edges.emplace(face[k], face[(k + 1) % face.size()]);
  }
  std::map<int, std::vector<std::size_t>> decades;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const std::uint32_t a = mesh.face(f)[0], b = mesh.face(f)[1];
    if (!edges.contains({b, a})) continue;  // the boundary of an open surface, where a vertex may lie
    const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
    decades[static_cast<int>(std::floor(std::log10(length)))].push_back(f);
  }
  std::vector<std::size_t> faces;
  for (const auto& [decade, of] : decades) faces.push_back(of[of.size() / 2]);
  return faces;
}

// The check as a control: planted T-vertices, one at a time, in edges of every length that the mesh has.
void measure_planted(const FaceMesh& mesh, bool open, Recorder& recorder) {
  double planted = 0, found = 0;
  for (const std::size_t face : face_of_each_decade(mesh)) {
    const MeshReport damaged = check_mesh(with_t_vertex(mesh, face), {.boundary_meant = open});
    ++planted;
    found += damaged[MeshFault::kTVertex] == 1 ? 1 : 0;
  }
  recorder.add("t_vertices_planted", "", planted);
  recorder.add("planted_not_found", "", planted - found);
}

// Checks every mesh on the way. An open surface keeps the boundary of its base, each of whose edges a
// subdivision divides into two.
void measure_faults(const Model& model, bool open, const GrownMesh& whole, Recorder& recorder) {
  MeshReport all;  // the sum of all reports
  std::size_t steps = 0, meant = 0, checked = 0;
  const auto check = [&](const GrownMesh& mesh, std::uint32_t subdivisions) {
    const MeshReport report = check_mesh(mesh.mesh, {.boundary_meant = open});
    if (steps == 0) meant = report.boundary_edges;
    if (open && report.boundary_edges != meant << subdivisions) {
      ++all.counts[static_cast<std::size_t>(MeshFault::kUnmeantBoundary)];
    }
    for (std::size_t k = 0; k < all.counts.size(); ++k) all.counts[k] += report.counts[k];
    ++steps;
    checked += mesh.mesh.faces();
  };
  const GrownMesh last = expand(model, {.after_step = check});
  const auto count = [&](std::initializer_list<MeshFault> faults) {
    double sum = 0;
    for (const MeshFault fault : faults) sum += static_cast<double>(all[fault]);
    return sum;
  };
  using enum MeshFault;
  recorder.add("meshes_checked", "", static_cast<double>(steps));
  recorder.add("faces_checked", "", static_cast<double>(checked));
  recorder.add("faults", "", static_cast<double>(all.faults()));
  recorder.add("t_vertices", "", count({kTVertex}));
  recorder.add("degenerate_faces", "",
               count({kFewCorners, kRepeatedVertex, kZeroArea, kZeroEdge, kNotFinite}));
  recorder.add("non_manifold", "", count({kManyFaces, kDirectedTwice, kSeveralFans}));
  recorder.add("unmeant_boundaries", "", count({kUnmeantBoundary}));
  // Whether the meshes that were checked are those that the expansion makes.
  const bool same = last.mesh.positions == whole.mesh.positions && last.mesh.corners == whole.mesh.corners &&
                    last.mesh.texture == whole.mesh.texture;
  recorder.add("differs_from_expansion", "", same ? 0 : 1);
  measure_planted(last.mesh, open, recorder);
}

void measure(const Case& test_case, const RunOptions&, Recorder& recorder, Progress&) {
  GrownMesh whole;
  for (int k = 0; k < kSamples; ++k) {
    const double time = seconds([&] { whole = expand(read_model(test_case)); });  // with reading its text
    recorder.add("time", "s", time);
    recorder.add("faces_per_second", "1/s", static_cast<double>(whole.mesh.faces()) / time);
    // A polygon of n corners is n - 2 triangles.
    const auto triangles = static_cast<double>(whole.mesh.corners.size() - 2 * whole.mesh.faces());
    recorder.add("triangles_per_second", "1/s", triangles / time);
  }
  const Model model = read_model(test_case);
  recorder.add("faces", "", static_cast<double>(whole.mesh.faces()));
  recorder.add("model_bytes", "B", static_cast<double>(model.bytes));
  recorder.add("mesh_bytes", "B", bytes_of(whole.mesh));
  recorder.add("bytes_ratio", "", bytes_of(whole.mesh) / static_cast<double>(model.bytes));
  measure_faults(model, kDrawn[test_case.parameters.choice("model")].open, whole, recorder);
}

constexpr std::array<std::string_view, 3> kForks{"fork_ridges", "fork_ridges_random", "forking_trunk"};
const std::array kForkSpecs{choice("model", kForks, "a model whose trunk forks")};
std::vector<Case> fork_cases(const RunOptions&) { return cases_by("model", kForkSpecs); }

// v per metre of every section of trunk and branches, and where the branches start.
void measure_v(const Model& model, Recorder& recorder) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::array<std::string_view, 2> kStems{"trunk", "branch"};
  double least = kInfinity, most = -kInfinity, branches = kInfinity, trunk = -kInfinity;
  const std::vector<StemSection> sections = sections_along(model, kStems);
  for (const StemSection& section : sections) {
    const double per_metre = (section.end_v - section.v) / section.length;
    least = std::min(least, per_metre);
    most = std::max(most, per_metre);
    if (section.symbol == "trunk") {
      trunk = std::max(trunk, section.end_v);
    } else {
      branches = std::min(branches, section.v);
    }
  }
  const auto starts = std::count_if(sections.begin(), sections.end(), [&](const StemSection& section) {
    return section.symbol == "branch" && section.v == branches;
  });
  recorder.add("v_sections", "", static_cast<double>(sections.size()));
  recorder.add("v_per_metre_least", "1/m", least);
  recorder.add("v_per_metre_most", "1/m", most);
  recorder.add("v_end_of_trunk", "", trunk);
  recorder.add("v_start_of_branches", "", branches);
  recorder.add("v_branches_start_there", "", static_cast<double>(starts));
}

void measure_fork(const Case& test_case, const RunOptions&, Recorder& recorder, Progress&) {
  measure_v(read_model(test_case), recorder);
  const Fork fork = find_fork(read_model(test_case), "branch");
  recorder.add("shared_vertices", "", static_cast<double>(fork.shared.size()));
  recorder.add("others_changed", "", fork.others_changed);
  for (std::size_t k = 0; k < fork.shared.size(); ++k) {
    recorder.add(fmt::format("u{}", k + 1), "", fork.shared[k].u);
    recorder.add(fmt::format("u{}_low", k + 1), "", fork.shared[k].alone[0]);
    recorder.add(fmt::format("u{}_high", k + 1), "", fork.shared[k].alone[1]);
  }
}

}  // namespace

extern const Experiment kModels{
    "meshgrow.models", "§4, §7: every model at every step, its bytes and its time", kSpecs, cases, measure,
    Experiment::kTimed};
extern const Experiment kFork{"meshgrow.fork", "Figure 9: texture coordinates at a fork", kForkSpecs,
                              fork_cases, measure_fork};

}  // namespace terrabench::meshgrow
