// §6 of "meshgrow": levels of detail by leaving out subdivision steps that make fine detail, and growing
// steps such as the spikes of the cactus. The pictures of each level are compared with those of the whole
// model, from near and from far.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "experiments/experiment.h"
#include "experiments/meshgrow/models.h"
#include "renderers/raytrace/raytraced_picture.h"

namespace terrabench::meshgrow {
namespace {

struct Level {
  std::string_view name, model, left_out;  // left_out: names of steps, separated by commas
};
// Each level of a model leaves out more than the one before.
constexpr std::array kLevels{
    Level{"cactus/full", "cactus", ""},
    Level{"cactus/no-spikes", "cactus", "spikes"},
    Level{"cactus/no-ribs", "cactus", "spikes,ribs"},
    Level{"cactus/grown", "cactus", "spikes,ribs,smooth"},
    Level{"chair/full", "chair", ""},
    Level{"chair/no-finish", "chair", "finish"},
    Level{"chair/no-folds", "chair", "finish,folds"},
    Level{"chair/grown", "chair", "finish,folds,smooth"},
    Level{"fork/full", "fork_ridges_random", ""},
    Level{"fork/no-ridges", "fork_ridges_random", "ridges"},
    Level{"fork/grown", "fork_ridges_random", "ridges,smooth"},
};

const std::array kSpecs{
    ParameterSpec{"model", std::string("cactus"), "", "name of the model"},
    ParameterSpec{"left_out", std::string(), "", "names of the steps that are left out, separated by commas"},
    ParameterSpec{"height", std::int64_t{512}, "pixels", "of the square pictures from near", 16, 4096},
    ParameterSpec{"samples", std::int64_t{8}, "", "paths per pixel of each picture from near", 1, 1024},
    ParameterSpec{"far", std::int64_t{8}, "", "distance of the far view, in distances of the near one", 2, 8},
};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const Level& level : kLevels) {
    Case& added = cases.emplace_back(Case{std::string(level.name), Parameters(kSpecs)});
    added.parameters.set("model", std::string(level.model));
    added.parameters.set("left_out", std::string(level.left_out));
    if (options.profile == Profile::kPaper) continue;
    added.parameters.set("height", std::int64_t{160});
  }
  return cases;
}

std::vector<std::string> names_in(std::string_view list) {
  std::vector<std::string> names;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    names.emplace_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return names;
}

struct Shown {
  Image image;
  std::vector<bool> covered;  // per pixel: its middle shows the model
};

Shown show(const ModelMesh& mesh, const PaintedModel& look, const growing::Model& model, const View& view,
           const RaytraceSettings& settings) {
  RayScene scene;
  scene.light = model_daylight();
  scene.background = glm::vec3(0.6F);
  scene.add_placed(in_materials(mesh, look, model.system));
  RaytracedPicture picture(scene, view, settings);
  picture.accumulate();
  Shown shown{picture.image(), {}};
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) shown.covered.push_back(picture.object(x, y) != 0);
  }
  return shown;
}

constexpr std::size_t kPairs = 6;

// What the level looks like and what the whole model does, traced with the same random paths.
struct Pair {
  const Shown *whole, *level;
  bool shows(std::size_t pixel) const { return whole->covered[pixel] || level->covered[pixel]; }
  double differs(std::size_t c) const {
    return static_cast<double>(int{whole->image.rgb[c]} - int{level->image.rgb[c]});
  }
};

struct Difference {
  double error = 0;      // root mean square, in channels of 0 to 255; 0 where the mean square is not above 0
  double certainty = 0;  // the mean square in its own standard errors
};

// Over the pixels that show either (all pairs agree on them, since coverage is that of a pixel's middle): a
// smaller model in the picture does not have a smaller error for that
// alone. The noise of the paths is taken out: the square of a difference is the mean product of two pairs'
// differences, whose noise has nothing in common. The standard error is the jackknife's over the pairs.
Difference difference(const std::array<Pair, kPairs>& pairs) {
  double all = 0, channels = 0;          // sums of products of different pairs
  std::array<double, kPairs> without{};  // the same, of all pairs but one
  for (std::size_t pixel = 0; pixel < pairs[0].whole->covered.size(); ++pixel) {
    if (!pairs[0].shows(pixel)) continue;
    channels += 3;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
      double sum = 0, squares = 0;
      for (const Pair& pair : pairs) {
        sum += pair.differs(c);
        squares += pair.differs(c) * pair.differs(c);
      }
      all += sum * sum - squares;
      for (std::size_t k = 0; k < kPairs; ++k) {
        const double own = pairs[k].differs(c);
        without[k] += (sum - own) * (sum - own) - (squares - own * own);
      }
    }
  }
  if (channels == 0) return {};
  constexpr double kN = kPairs;
  double mean = 0, variance = 0;
  for (double& each : without) each /= channels * (kN - 1) * (kN - 2);
  for (const double each : without) mean += each / kN;
  for (const double each : without) variance += (each - mean) * (each - mean) * (kN - 1) / kN;
  const double square = all / (channels * kN * (kN - 1));
  return {std::sqrt(std::max(0.0, square)), variance > 0 ? square / std::sqrt(variance) : 0};
}

// The picture from `times` as far away, in pixels of the same angle, cut to what the near view shows. A pixel
// covers times² as much of the model, and gets as many times the paths: both views have the same number.
void move_away(int times, View& view, RaytraceSettings& settings) {
  const auto share = 1 / static_cast<float>(times);
  view.eye = view.target + static_cast<float>(times) * (view.eye - view.target);
  view.vertical_fov = 2 * std::atan(share * std::tan(0.5F * view.vertical_fov));
  view.width = view.height = std::max(1, view.height / times);
  settings.samples *= times * times;
}

// Of one mesh, from near and from far, each view with the random paths of every pair.
using Pictures = std::array<std::array<Shown, kPairs>, 2>;

Pictures pictures_of(const ModelMesh& mesh, const Bounds& whole, const growing::Model& model,
                     const Case& test_case, const RunOptions& options) {
  const int height = test_case.integer("height");
  View view = overview(whole, height, height, {0.45F, 0.3F, 1.0F});
  RaytraceSettings settings{.samples = test_case.integer("samples"), .bounces = 1};
  Pictures pictures;
  for (std::array<Shown, kPairs>& of_view : pictures) {
    for (std::uint32_t k = 0; k < kPairs; ++k) {
      settings.seed = static_cast<std::uint32_t>(options.seed) + 0x9E37 * k;
      of_view[k] = show(mesh, painted(test_case.parameters.text("model")), model, view, settings);
    }
    move_away(test_case.integer("far"), view, settings);
  }
  return pictures;
}

// All levels of a model are compared with the same pictures of the whole, which are kept for the next level.
const Pictures& pictures_of_whole(const ModelMesh& mesh, const growing::Model& model, const Case& test_case,
                                  const RunOptions& options) {
  static std::pair<std::string, Pictures> kept;
  const std::string key =
      fmt::format("{} {} {} {} {}", test_case.parameters.text("model"), test_case.integer("height"),
                  test_case.integer("samples"), test_case.integer("far"), options.seed);
  if (kept.first != key) kept = {key, pictures_of(mesh, bounds_of(mesh.mesh), model, test_case, options)};
  return kept.second;
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress&) {
  const std::string name = test_case.parameters.text("model");
  const growing::Model model = growing::parse_model(growing::model_text(name), name);
  const growing::ExpandOptions without{.leave_out = names_in(test_case.parameters.text("left_out"))};
  const ModelMesh full = triangles_of(growing::expand(model).mesh);
  const ModelMesh level = triangles_of(growing::expand(model, without).mesh);
  recorder.add("triangles", "", static_cast<double>(level.mesh.triangles()));
  const Pictures& whole = pictures_of_whole(full, model, test_case, options);
  const Pictures reduced =
      without.leave_out.empty() ? whole : pictures_of(level, bounds_of(full.mesh), model, test_case, options);
  for (std::size_t v = 0; v < whole.size(); ++v) {
    std::array<Pair, kPairs> pairs;
    for (std::size_t k = 0; k < kPairs; ++k) pairs[k] = {&whole[v][k], &reduced[v][k]};
    const Difference differs = difference(pairs);
    const std::string_view name_of_view = v == 0 ? "near" : "far";
    recorder.add(fmt::format("{}_error", name_of_view), "", differs.error);
    recorder.add(fmt::format("{}_certainty", name_of_view), "", differs.certainty);
  }
}

}  // namespace

extern const Experiment kLod{"meshgrow.lod", "§6: models without their fine steps, from near and from far",
                             kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
