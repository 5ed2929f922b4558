// §6 and §8 of "meshgrow", which the paper leaves to future work: a forest whose full expansion would have
// more than 10⁹ faces is ray traced while only those of its plants are expanded, to the level that the view
// needs, that rays reach, in a cache of bounded bytes. Pictures are compared across sizes of the cache and
// numbers of threads, and those of a small forest with its full expansion, traced by the eager path tracer.
#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>

#include "experiments/experiment.h"
#include "experiments/figures/figure.h"
#include "experiments/meshgrow/forest_scene.h"
#include "experiments/stopwatch.h"
#include "renderers/raytrace/raytraced_picture.h"
#include "results/store/format.h"

namespace terrabench::meshgrow {
namespace {

constexpr std::string_view kKinds[] = {"lazy", "error"};

const std::array kSpecs{
    choice("kind", kKinds, "of the measurement: of lazy expansion, or of its error against full expansion"),
    ParameterSpec{"instances", std::int64_t{500}, "", "plants in the forest", 0, 10'000'000},
    ParameterSpec{"area", 60.0, "m²", "of ground per plant", 1, 1e6},
    ParameterSpec{"spacing", 1.5, "pixels", "a level has one face per square of this side; 0: finest", 0,
                  100},
    ParameterSpec{"uniform", false, "",
                  "all plants at one level, with no fewer faces than the view's choice"},
    ParameterSpec{"cache", std::int64_t{512}, "MiB", "bound of the parts in memory", 1, 1 << 20},
    ParameterSpec{"threads", std::int64_t{0}, "", "that trace and expand; 0: all", 0, 1024},
    ParameterSpec{"width", std::int64_t{240}, "pixels", "of the picture", 8, 8192},
    ParameterSpec{"samples", std::int64_t{2}, "", "paths per pixel", 1, 65536},
    ParameterSpec{"tile", std::int64_t{192}, "pixels",
                  "sides of the parts of the picture whose rays are sorted together", 1, 4096},
    ParameterSpec{"bounces", std::int64_t{1}, "", "reflections between surfaces", 0, 64},
    ParameterSpec{"shown", 0.75, "", "width of the picture, per side of the forest", 0.01, 10},
    ParameterSpec{"figure", false, "", "whether the picture is kept"},
};

struct Variant {
  std::string_view name;
  std::int64_t cache, threads;
};
constexpr std::array kVariants{Variant{"cache=1024", 1024, 0}, Variant{"cache=256", 256, 0},
                               Variant{"cache=128", 128, 0}, Variant{"threads=1", 1024, 1}};
// The finest level, and from a face per pixel down by halves.
constexpr std::array kSpacings{0.0, 0.25, 0.5, 1.0};
constexpr double kUniformSpacing = 0.5;  // whose faces the uniform choice has to match

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  const auto add = [&](std::string name) -> Parameters& {
    Parameters& parameters = cases.emplace_back(Case{std::move(name), Parameters(kSpecs)}).parameters;
    if (!paper) {
      parameters.set("instances", std::int64_t{40});
      parameters.set("width", std::int64_t{96});
    }
    return parameters;
  };
  Parameters& picture = add("picture");
  picture.set("figure", true);
  picture.set("area", 150.0);  // open woodland: the ground shows between the crowns
  picture.set("cache", std::int64_t{1280});
  picture.set("spacing", 4.0);
  if (paper) {
    picture.set("instances", std::int64_t{120});
    picture.set("width", std::int64_t{1600});
    picture.set("samples", std::int64_t{4});
    // Too many plants to draw at that size in minutes.
    Parameters& memory = add("memory");
    memory.set("instances", std::int64_t{300});
    memory.set("cache", std::int64_t{1024});
    memory.set("spacing", 8.0);
    memory.set("width", std::int64_t{320});
    memory.set("samples", std::int64_t{1});
  }
  // So few paths that they cannot reach all plants.
  Parameters& part = add("part");
  part.set("instances", std::int64_t{40});
  part.set("shown", 0.3);
  part.set("bounces", std::int64_t{0});
  part.set("width", std::int64_t{8});
  part.set("samples", std::int64_t{1});
  for (const Variant& variant : kVariants) {
    Parameters& parameters = add(std::string(variant.name));
    parameters.set("cache", paper ? variant.cache : variant.cache / 2);
    parameters.set("instances", std::int64_t{40});  // or the small caches expand the same parts for minutes
    parameters.set("threads", variant.threads);
  }
  const auto add_error = [&](std::string name, double spacing, bool uniform) {
    Parameters& parameters = add(std::move(name));
    parameters.set("kind", std::string("error"));
    parameters.set("spacing", spacing);
    parameters.set("uniform", uniform);
    parameters.set("instances", std::int64_t{12});
    parameters.set("width", std::int64_t{240});
    parameters.set("samples", std::int64_t{32});
    parameters.set("cache", std::int64_t{1024});
  };
  for (const double spacing : kSpacings) add_error(fmt::format("spacing={}", spacing), spacing, false);
  add_error("uniform", kUniformSpacing, true);
  return cases;
}

// What was made last for a key: cases that follow one another share it.
template <class Key, class Make>
const auto& made_last(const Key& key, const Make& make) {
  static std::optional<std::pair<Key, decltype(make())>> last;
  if (!last || last->first != key) {
    last.reset();
    last.emplace(key, make());
  }
  return last->second;
}

View view_of(const glm::vec3& eye, const glm::vec3& target, float vertical_fov, int width) {
  View view;
  view.eye = eye;
  view.target = target;
  view.vertical_fov = vertical_fov;
  view.width = width;
  view.height = std::max(8, width / 2);
  view.near = 0.1F;
  view.far = 4 * glm::distance(eye, target);
  return view;
}

// From the air, so far away that leaves are small in the picture. It shows the middle of the forest, so that
// trees or the ground between them fill it to all edges.
View view_from_the_air(const Forest& forest, int width, float shown) {
  constexpr float kAway = 2.5F;  // the eye, in sides of the forest
  const float side = forest.side(), middle = 0.5F * side;
  const glm::vec3 target(middle, forest.height(middle, middle) + 4, middle);
  const glm::vec3 from = glm::normalize(glm::vec3(0.1F, 0.52F, 0.85F));
  return view_of(target + kAway * side * from, target, 2 * std::atan(0.25F * shown / kAway), width);
}

// From beside the first trees, where levels differ most.
View view_from_beside(const Forest& forest, int width) {
  const float side = forest.side(), x = 0.5F * side, ground = forest.height(x, 0.98F * side);
  return view_of({x, ground + 24, side + 60}, {x, ground + 9, side}, 0.42F, width);
}

double checksum(const CoherentPicture& picture) {
  std::uint64_t sum = 0xCBF29CE484222325U;
  for (const glm::vec3& pixel : picture.radiance) {
    for (int c = 0; c < 3; ++c) sum = (sum ^ std::bit_cast<std::uint32_t>(pixel[c])) * 0x100000001B3U;
  }
  return static_cast<double>(sum >> 12);  // 52 bits, which a double holds
}

// The peak of resident memory starts again from what is resident now, where the system allows it.
void reset_peak_resident() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}
double peak_resident() {
  std::ifstream status("/proc/self/status");
  unsigned long long kibibytes = 0;
  for (std::string line; std::getline(status, line);) {
    if (std::sscanf(line.c_str(), "VmHWM: %llu kB", &kibibytes) == 1) return 1024.0 * kibibytes;
  }
  throw environment_error("the system does not report peak resident memory", "/proc/self/status",
                          "measure on Linux");
}

CoherentPicture traced(const LazyForest& lazy, const View& view, const Case& test_case,
                       const RunOptions& options, Progress& progress) {
  const CoherentSettings settings{.samples = test_case.integer("samples"),
                                  .bounces = test_case.integer("bounces"),
                                  .seed = static_cast<std::uint32_t>(options.seed),
                                  .tile = test_case.integer("tile")};
  const int threads = test_case.integer("threads");
  std::optional<tbb::global_control> more;
  if (threads > 0) {
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  CoherentPicture picture;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { picture = trace_coherent(lazy.parts(), view, settings, &progress); });
  return picture;
}

void record(const growing::Expanded& expanded, const Forest& forest, Recorder& recorder) {
  const auto total = static_cast<double>(forest.plants().total_faces());
  recorder.add("instances", "", static_cast<double>(forest.plants().instances().size()));
  recorder.add("faces_total", "", total);
  recorder.add("instances_expanded", "", static_cast<double>(expanded.parts));
  recorder.add("faces_expanded", "", static_cast<double>(expanded.faces));
  recorder.add_varying("faces_expanded_again", "", static_cast<double>(expanded.again));
  recorder.add("share_expanded", "", total > 0 ? static_cast<double>(expanded.faces) / total : 0);
  recorder.add("parts_outside_bounds", "", static_cast<double>(expanded.outside));
  recorder.add_varying("cache_hits", "", static_cast<double>(expanded.cache.hits));
  recorder.add_varying("cache_misses", "", static_cast<double>(expanded.cache.misses));
  recorder.add_varying("cache_evictions", "", static_cast<double>(expanded.cache.evictions));
  recorder.add_varying("cache_peak", "B", static_cast<double>(expanded.cache.peak_bytes));
}

void measure_lazy(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const auto instances = static_cast<std::uint64_t>(test_case.parameters.integer("instances"));
  const double area = test_case.parameters.number("area");
  // Planting estimates every instance, which takes long.
  const std::unique_ptr<const Forest>& forest = made_last(std::tuple(instances, area, options.seed), [&] {
    const ForestSettings settings{.instances = instances, .area = area, .seed = options.seed};
    return std::make_unique<const Forest>(settings, &progress);
  });
  const View view = view_from_the_air(*forest, test_case.integer("width"),
                                      static_cast<float>(test_case.parameters.number("shown")));
  const auto bound = static_cast<std::size_t>(test_case.parameters.integer("cache")) << 20U;

  reset_peak_resident();
  HeapCounter::reset_peak();
  const HeapScope heap;
  LazyForest lazy(*forest, forest->plants().choose_levels(view, {test_case.parameters.number("spacing")}),
                  bound);
  Stopwatch tracing;
  const CoherentPicture picture = traced(lazy, view, test_case, options, progress);
  recorder.add("seconds", "s", tracing.seconds());
  recorder.add_varying("heap_peak", "B", static_cast<double>(HeapCounter::peak()));
  recorder.add_varying("resident_peak", "B", peak_resident());
  const Memory memory = lazy.memory();
  const double pictures = 16.0 * static_cast<double>(picture.radiance.size());
  recorder.add_varying("heap_held", "B", static_cast<double>(heap.held()) - pictures);
  recorder.add_varying("memory", "B", static_cast<double>(memory.total()));
  recorder.add("cache_bound", "B", static_cast<double>(bound));
  recorder.add("faces_chosen", "", static_cast<double>(lazy.faces_chosen()));
  record(lazy.expanded(), *forest, recorder);
  recorder.add("checksum", "", checksum(picture));
  if (!test_case.parameters.flag("figure")) return;
  const auto ground = static_cast<std::uint32_t>(forest->plants().instances().size()) + 1;
  const auto share = [&](std::uint32_t object) {
    return static_cast<double>(std::ranges::count(picture.objects, object)) /
           static_cast<double>(picture.objects.size());
  };
  recorder.add("sky_shown", "", share(0));
  recorder.add("ground_shown", "", share(ground));
  const figures::Sheet sheet = figures::panel_sheet(
      {{{picture.image(),
         fmt::format("{} trees and bushes", format_count(forest->plants().instances().size()))}}});
  sheet.write(recorder.figure(
      "meshgrow.lazy-forest",
      fmt::format(
          "A forest of {} quaking aspens, tamaracks, California black oaks and young black tupelos of {} "
          "faces in total, of which {} were expanded",
          format_count(forest->plants().instances().size()), format_count(forest->plants().total_faces()),
          format_count(lazy.expanded().faces))));
}

// All instances at their finest level in one scene of the eager path tracer.
Image eager(const Forest& forest, const View& view, const Case& test_case, std::uint64_t seed) {
  const growing::PlantedScene& plants = forest.plants();
  std::vector<ModelMesh> meshes(plants.instances().size());
  RayScene scene;
  scene.light = model_daylight();
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    meshes[i] = triangles_of(plants.mesh(i, 0).mesh);
    const auto material = [&forest, &mesh = meshes[i], i](SurfacePoint point) {
      point.instance = i;
      point.mesh = mesh.symbols[point.triangle];
      return forest.material(point);
    };
    const std::uint32_t mesh =
        scene.add({.mesh = &meshes[i].mesh, .texture = meshes[i].texture, .material_at = material});
    scene.instances.push_back({mesh, growing::to_world(plants.instances()[i])});
  }
  const auto soil = [&](SurfacePoint point) {
    point.instance = static_cast<std::uint32_t>(meshes.size());
    return forest.material(point);
  };
  scene.add_placed({.mesh = &forest.ground().mesh, .material_at = soil});
  RaytracedPicture picture(
      scene, view,
      {.samples = test_case.integer("samples"), .bounces = 1, .seed = static_cast<std::uint32_t>(seed)});
  picture.accumulate();
  return picture.image();
}

// Root mean square difference of the channels, 0 to 255, of the means of blocks of pixels: of single pixels
// (block = 1), or without the noise and the places of single leaves.
double difference(const Image& a, const Image& b, int block) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y + block <= a.height; y += block) {
    for (int x = 0; x + block <= a.width; x += block, count += 3) {
      for (std::size_t c = 0; c < 3; ++c) {
        int step = 0;
        for (int k = 0; k < block * block; ++k) {
          const int at_x = x + k % block, at_y = y + k / block;
          step += int{a.pixel(at_x, at_y)[c]} - int{b.pixel(at_x, at_y)[c]};
        }
        const double mean = static_cast<double>(step) / (block * block);
        sum += mean * mean;
      }
    }
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

// The coarsest level for all plants alike that has no fewer faces than the view's choice.
std::vector<std::uint8_t> uniform_levels(const growing::PlantedScene& plants,
                                         const std::vector<std::uint8_t>& chosen) {
  const auto faces = [&](const std::vector<std::uint8_t>& levels) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) sum += plants.faces(i, levels[i]);
    return sum;
  };
  std::vector<std::uint8_t> levels(chosen.size());
  for (std::size_t level = 16; level-- > 0;) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i] = static_cast<std::uint8_t>(std::min(level, plants.levels(i) - 1));
    }
    if (faces(levels) >= faces(chosen)) break;
  }
  return levels;
}

void measure_error(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const auto instances = static_cast<std::uint64_t>(test_case.parameters.integer("instances"));
  const Forest forest({.instances = instances, .area = 150, .all_leaves = false, .seed = options.seed});
  const View view = view_from_beside(forest, test_case.integer("width"));
  std::vector<std::uint8_t> levels =
      forest.plants().choose_levels(view, {test_case.parameters.number("spacing")});
  if (test_case.parameters.flag("uniform")) levels = uniform_levels(forest.plants(), levels);
  LazyForest lazy(forest, levels, static_cast<std::size_t>(test_case.parameters.integer("cache")) << 20U);
  const Image image = traced(lazy, view, test_case, options, progress).image();
  // Two pictures of the full expansion, by different paths.
  const std::tuple key(options.seed, instances, view.width, test_case.integer("samples"));
  const auto& [truth, other] = made_last(key, [&] {
    return std::pair(eager(forest, view, test_case, options.seed),
                     eager(forest, view, test_case, options.seed + 1));
  });
  recorder.add("error", "", difference(image, truth, 1));
  recorder.add("block_error", "", difference(image, truth, 8));
  recorder.add("noise", "", difference(truth, other, 1));
  recorder.add("block_noise", "", difference(truth, other, 8));
  recorder.add("faces_chosen", "", static_cast<double>(lazy.faces_chosen()));
  record(lazy.expanded(), forest, recorder);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  (test_case.parameters.choice("kind") == 0 ? measure_lazy : measure_error)(test_case, options, recorder,
                                                                            progress);
}

}  // namespace

extern const Experiment kForest{"meshgrow.forest",
                                "§6, §8: a forest of 10⁹ faces, expanded only where rays reach it",
                                kSpecs,
                                cases,
                                measure,
                                Experiment::kTimed};

}  // namespace terrabench::meshgrow
