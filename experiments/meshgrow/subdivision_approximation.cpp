// §3 of "meshgrow": displacements bounded by the local scale factor at every step give a fractal surface; if
// subdivision stops after finitely many steps, the error in vertex positions is on the order of the local
// scale factor. Displacements here are random, up to one scale factor; the finest mesh stands for the
// surface.
//
// Theory. At each later step a vertex moves by a bounded number of the scale factors of that step, which fall
// geometrically: their sum, the error, is in proportion to the scale factor of the step that was the last. On
// a smooth surface the error falls as the square of the scale factor, so that its ratio halves at each step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "experiments/cases.h"
#include "experiments/meshgrow/root_mean_square.h"
#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/refinement.h"

namespace terrabench::meshgrow {
namespace {

using namespace subdivision;

constexpr std::array<std::string_view, 2> kMeshes{"plane", "sphere"};
constexpr int kStops = 4;  // steps after which subdivision may stop; the others make the surface
const std::array kSpecs{
    choice("mesh", kMeshes, "base mesh"),
    ParameterSpec{"levels", std::int64_t{8}, "", "steps that stand for all", kStops + 1, 10},
    ParameterSpec{"bound", 1.0, "scale factors", "largest displacement", 0, 1},
};

std::vector<Case> cases(const RunOptions& options) {
  return cases_by("mesh", kSpecs, {{"levels", std::int64_t{options.profile == Profile::kPaper ? 8 : 7}}});
}

double mean_of(const Array<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress&) {
  const FaceMesh base =
      at.parameters.choice("mesh") == 0 ? growing::plane({4, 4}, 4, 4).mesh : growing::sphere(1, 2).mesh;
  const int levels = at.integer("levels");
  const Refinement refinement(base, levels, {.boundary = Boundary::kEdgeAndCorner});
  PlacementRule rough;
  rough.displacements.resize(1);
  rough.displacements[0].amount = {.kind = Signal::Kind::kUniform,
                                   .amplitude = static_cast<float>(at.parameters.number("bound")),
                                   .seed = options.seed};
  std::vector<LevelPoints> meshes{{base.positions, {}}};
  const auto next = [&](const LevelPoints& points, int level, const PlacementRule& rule) {
    return next_points(refinement, level, points, rule, static_cast<std::uint32_t>(level + 1));
  };
  for (int level = 0; level < levels; ++level) meshes.push_back(next(meshes.back(), level, rough));
  const std::vector<glm::vec3>& surface = meshes.back().positions;

  for (int stop = 1; stop <= kStops; ++stop) {
    const auto surface_at = [&](int level) {
      return local_surface(refinement.topology(level), meshes[static_cast<std::size_t>(level)].positions, {},
                           FrameRule{}, false);
    };
    const LocalSurface here = surface_at(stop), after = surface_at(stop + 1);
    const std::vector<glm::vec3>& stopped = meshes[static_cast<std::size_t>(stop)].positions;
    RootMeanSquare error, share, turn, finished;
    double largest = 0;
    for (std::size_t v = 0; v < stopped.size(); ++v) {  // a vertex keeps its number in finer meshes
      const auto off = static_cast<double>(glm::distance(stopped[v], surface[v]));
      const double of_scale = off / static_cast<double>(here.scales[v]);
      error.add(off);
      share.add(of_scale);
      largest = std::max(largest, of_scale);
      const float cosine = std::clamp(glm::dot(here.normals[v], after.normals[v]), -1.0F, 1.0F);
      turn.add(static_cast<double>(glm::degrees(std::acos(cosine))));
    }
    // All vertices of the surface, where standard steps follow instead.
    LevelPoints smooth = meshes[static_cast<std::size_t>(stop)];
    for (int level = stop; level < levels; ++level) smooth = next(smooth, level, PlacementRule{});
    for (std::size_t v = 0; v < surface.size(); ++v) {
      finished.add(static_cast<double>(glm::distance(smooth.positions[v], surface[v])));
    }
    recorder.add(fmt::format("scale_{}", stop), "m", mean_of(here.scales));
    recorder.add(fmt::format("error_{}", stop), "m", error.value());
    recorder.add(fmt::format("error_in_scales_{}", stop), "", share.value());
    recorder.add(fmt::format("largest_in_scales_{}", stop), "", largest);
    recorder.add(fmt::format("finished_in_scales_{}", stop), "", finished.value() / mean_of(here.scales));
    recorder.add(fmt::format("normal_turns_{}", stop), "°", turn.value());
  }
}

}  // namespace

extern const Experiment kApproximation{"meshgrow.approximation",
                                       "§3: the error where subdivision of a fractal surface stops", kSpecs,
                                       cases, measure};

}  // namespace terrabench::meshgrow
