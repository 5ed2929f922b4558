// §3 of "meshgrow": after finitely many steps with displacements, standard steps follow, so the limit surface
// can be evaluated at any point, as by Stam (1998). Three meshes with random displacements, and the chair of
// figure 11 after the step that folds its cushion. Points at random places of faces are evaluated from the
// mesh itself and from the mesh two steps later; points that become vertices of a finer mesh are compared
// with the limit points of these, which limit.h gives by masks.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "experiments/cases.h"
#include "experiments/meshgrow/growing_steps.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/limit.h"
#include "representations/procedural_mesh/subdivision/limit_at.h"
#include "representations/procedural_mesh/subdivision/refinement.h"
#include "terrain/splitmix.h"

namespace terrabench::meshgrow {
namespace {

using namespace subdivision;

constexpr std::array<std::string_view, 4> kMeshes{"plane", "sphere", "prism", "chair"};
const std::array kSpecs{
    choice("mesh", kMeshes, "after two steps with random displacements; the chair after that with the folds"),
    ParameterSpec{"faces", std::int64_t{400}, "", "faces with points, spread over the mesh", 1, 100'000},
    ParameterSpec{"amplitude", 0.15, "scale factors", "largest random displacement", 0, 1},
};
std::vector<Case> cases(const RunOptions&) { return cases_by("mesh", kSpecs); }

constexpr int kFiner = 4;    // refinements until a point becomes a vertex
constexpr int kLater = 2;    // until the later evaluation
constexpr int kPerFace = 3;  // random points

FaceMesh displaced_mesh(const Case& at, std::uint64_t seed) {
  const std::string& name = at.parameters.text("mesh");
  if (name == "chair") {
    const growing::Model model = growing::parse_model(growing::model_text(name), name);
    growing::ExpandOptions folded;
    folded.leave_out = {"finish"};
    return growing::expand(model, folded).mesh;
  }
  PlacementRule rough;
  rough.displacements.resize(1);
  rough.displacements[0].amount = {.kind = Signal::Kind::kUniform,
                                   .amplitude = static_cast<float>(at.parameters.number("amplitude")),
                                   .seed = seed};
  const FaceMesh base = name == "plane" ? growing::plane({4, 4}, 4, 4).mesh : shape(name);
  return subdivide(base, std::array{rough, rough}, {.boundary = Boundary::kEdgeAndCorner});
}

// A mesh and its standard refinements, with a point per vertex.
class Levels {
 public:
  explicit Levels(const FaceMesh& mesh) : refinement_(mesh, kFiner, {.boundary = Boundary::kEdgeAndCorner}) {
    points_.emplace_back(mesh.positions.begin(), mesh.positions.end());
    for (int level = 0; level < kFiner; ++level) {
      const Topology& t = topology(level);
      std::vector<glm::dvec3> finer(child_vertices(t));
      place_standard<glm::dvec3>(t, refinement_.stencils(level), points_.back(), finer);
      points_.push_back(std::move(finer));
    }
    limits_.resize(points_.back().size());
    limit_points<glm::dvec3>(topology(kFiner), points_.back(), limits_);
  }
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

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const Levels levels(displaced_mesh(at, options.seed));
  const Topology& mesh = levels.topology(0);
  const auto asked = static_cast<std::uint32_t>(at.integer("faces"));
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

extern const Experiment kLimitAt{"meshgrow.limit-at", "§3: the limit surface at any point", kSpecs, cases,
                                 measure};

}  // namespace terrabench::meshgrow
