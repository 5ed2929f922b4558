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
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "terrain/splitmix.h"

namespace terrabench::meshgrow {
namespace {

using namespace subdivision;

constexpr RefinementOptions kCornersStay{.boundary = Boundary::kEdgeAndCorner};

constexpr std::array<std::string_view, 3> kMeshes{"plane", "sphere", "prism"};
const std::array kSpecs{
    choice("mesh", kMeshes,
           "base mesh: all vertices regular, or extraordinary ones with 3, or 3 and 5 faces"),
    ParameterSpec{"steps", std::int64_t{6}, "", "standard steps after two with random displacements", 2, 8},
    ParameterSpec{"amplitude", 0.15, "scale factors", "largest displacement", 0, 1},
};

std::vector<Case> cases(const RunOptions&) { return cases_by("mesh", kSpecs); }

// After two steps with random displacements.
FaceMesh rough_mesh(std::string_view name, double amplitude, std::uint64_t seed) {
  const FaceMesh base = name == "plane" ? growing::plane({4, 4}, 4, 4).mesh : shape(name);
  const std::vector rules(2, fractal_rule(static_cast<float>(amplitude), seed));
  return subdivide(base, rules, kCornersStay);
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
  recorder.add(fmt::format("rms_ratio_{}", step), "", now.rms / before.rms);
  recorder.add(fmt::format("largest_ratio_{}", step), "", now.largest / before.largest);
  for (const auto& [n, d] : now.vertices) {
    const double vertex = d / before.vertices.at(n), ring = now.rings.at(n) / before.rings.at(n);
    if (n == 4 || step == last) recorder.add(fmt::format("vertex_{}_ratio_{}", n, step), "", vertex);
    if (step != last) continue;
    const double symmetric = ring_eigenvalue(n, 0), subdominant = n == 4 ? 0.25 : ring_eigenvalue(n, 1);
    recorder.add(fmt::format("ring_{}_ratio_{}", n, step), "", ring);
    recorder.add(fmt::format("vertex_{}_eigenvalue", n), "", symmetric);
    recorder.add(fmt::format("ring_{}_eigenvalue", n), "", subdominant);
    recorder.add(fmt::format("vertex_{}_off_eigenvalue", n), "", std::abs(vertex - symmetric));
    recorder.add(fmt::format("ring_{}_off_eigenvalue", n), "", std::abs(ring - subdominant));
  }
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::string& name = test_case.parameters.text("mesh");
  const FaceMesh start = rough_mesh(name, test_case.parameters.number("amplitude"), options.seed);
  const int steps = test_case.integer("steps");
  const Refinement refinement(start, steps, kCornersStay);
  std::vector<std::size_t> followed;
  for (std::uint32_t v = 0; v < refinement.topology(0).vertices; ++v) {
    const std::size_t faces = refinement.topology(0).uses_of(v).size();
    // All inner vertices of the plane have 4 faces.
    const bool inner = name != "plane" || faces == 4;
    followed.push_back(inner ? faces : 0);
  }
  const std::vector<std::vector<glm::dvec3>> points =
      standard_points(refinement, {start.positions.begin(), start.positions.end()});
  std::vector<glm::dvec3> first_limits;
  Distances before;
  double drift = 0;
  for (int step = 0; step <= steps; ++step) {
    const std::vector<glm::dvec3>& here = points[static_cast<std::size_t>(step)];
    const std::vector<glm::dvec3> limits = limit_points(refinement.topology(step), here);
    if (step == 0) first_limits = limits;
    for (std::size_t v = 0; v < first_limits.size(); ++v) {
      drift = std::max(drift, glm::length(limits[v] - first_limits[v]));
    }
    Distances now = distances(refinement.topology(step), here, limits, followed);
    if (step > 0) record_step(recorder, step, steps, now, before);
    before = std::move(now);
  }
  recorder.add("limit_drift", "m", drift);
}

// §3, too: the limit surface can be evaluated at any point, as by Stam (1998). Three meshes with random
// displacements, and the chair of figure 11 after the step that folds its cushion. Points at random places of
// faces are evaluated from the mesh itself and from the mesh two steps later; points that become vertices of
// a finer mesh are compared with the limit points of these, which masks give.
constexpr std::array<std::string_view, 4> kEvaluated{"plane", "sphere", "prism", "chair"};
const std::array kPointSpecs{
    choice("mesh", kEvaluated,
           "after two steps with random displacements; the chair after that with the folds"),
    ParameterSpec{"faces", std::int64_t{400}, "", "faces with points, spread over the mesh", 1, 100'000},
    ParameterSpec{"amplitude", 0.15, "scale factors", "largest random displacement", 0, 1},
};
std::vector<Case> point_cases(const RunOptions&) { return cases_by("mesh", kPointSpecs); }

constexpr int kFiner = 4;    // refinements until a point becomes a vertex
constexpr int kLater = 2;    // until the later evaluation
constexpr int kPerFace = 3;  // random points

// A mesh and its standard refinements, with a point per vertex.
class Levels {
 public:
  explicit Levels(const FaceMesh& mesh)
      : refinement_(mesh, kFiner, kCornersStay),
        points_(standard_points(refinement_, {mesh.positions.begin(), mesh.positions.end()})),
        limits_(limit_points(topology(kFiner), points_.back())) {}
  const Topology& topology(int level) const { return refinement_.topology(level); }
  glm::dvec3 evaluate(int level, std::uint32_t face, glm::dvec2 at) const {
    return limit_at(topology(level), points_[static_cast<std::size_t>(level)], face, at);
  }
  // By the mask of the first corner of a face of the finest mesh.
  glm::dvec3 vertex_limit(std::uint32_t face) const { return limits_[topology(kFiner).corners[4 * face]]; }
  // What a method without a limit would give: the place on the face itself.
  glm::dvec3 on_face(std::uint32_t face, glm::dvec2 at) const {
    const auto corner = [&](std::uint32_t k) { return points_[0][topology(0).corners[4 * face + k]]; };
    return (1 - at.y) * ((1 - at.x) * corner(0) + at.x * corner(1)) +
           at.y * ((1 - at.x) * corner(3) + at.x * corner(2));
  }

 private:
  Refinement refinement_;
  std::vector<std::vector<glm::dvec3>> points_;  // by level
  std::vector<glm::dvec3> limits_;               // of the finest
};

void measure_points(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::string& name = test_case.parameters.text("mesh");
  const Levels levels(
      name == "chair"
          ? growing::expand(growing::parse_model(growing::model_text(name), name), {.leave_out = {"finish"}})
                .mesh
          : rough_mesh(name, test_case.parameters.number("amplitude"), options.seed));
  const Topology& mesh = levels.topology(0);
  const auto asked = static_cast<std::uint32_t>(test_case.integer("faces"));
  const std::uint32_t stride = std::max(1U, mesh.faces() / asked);
  double points = 0, irregular = 0, later_off = 0, vertex_off = 0, face_off = 0;
  for (std::uint32_t face = 0; face < mesh.faces(); face += stride) {
    const std::uint64_t key = combine(options.seed, face);
    auto random = [&, k = std::uint64_t{0}]() mutable { return random_share(key, k++); };
    const bool extraordinary = std::any_of(&mesh.corners[4 * face], &mesh.corners[4 * face] + 4,
                                           [&](std::uint32_t v) { return mesh.uses_of(v).size() != 4; });
    for (int k = 0; k < kPerFace; ++k) {
      glm::dvec2 place{random(), random()};
      const glm::dvec3 limit = levels.evaluate(0, face, place);
      face_off = std::max(face_off, glm::length(limit - levels.on_face(face, place)));
      std::uint32_t child = face;
      for (int step = 0; step < kLater; ++step) {
        child = 4 * child + static_cast<std::uint32_t>(child_at(place));
      }
      later_off = std::max(later_off, glm::length(limit - levels.evaluate(kLater, child, place)));
      ++points;
      irregular += extraordinary ? 1 : 0;
    }
    std::array<int, kFiner> path{};
    std::uint32_t finest = face;
    for (int& child : path) {
      child = static_cast<int>(4 * random());
      finest = 4 * finest + static_cast<std::uint32_t>(child);
    }
    glm::dvec2 place(0);  // of the first corner of the finest face
    for (auto child = path.rbegin(); child != path.rend(); ++child) place = place_in_parent(*child, place);
    vertex_off =
        std::max(vertex_off, glm::length(levels.evaluate(0, face, place) - levels.vertex_limit(finest)));
    ++points;
  }
  recorder.add("points", "", points);
  recorder.add("at_extraordinary", "", irregular);
  recorder.add("later_off", "m", later_off);
  recorder.add("vertex_off", "m", vertex_off);
  recorder.add("face_off", "m", face_off);
}

}  // namespace

extern const Experiment kLimit{"meshgrow.limit", "§3: distances to the limit surface", kSpecs, cases,
                               measure};
extern const Experiment kLimitAt{"meshgrow.limit-at", "§3: the limit surface at any point", kPointSpecs,
                                 point_cases, measure_points};

}  // namespace terrabench::meshgrow
