// Table 2: triangles that each of the four methods draws along one walk, time per frame, and time to choose
// the triangles. All methods get the same views.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "experiments/experiment.h"
#include "experiments/mrbsp/ground.h"
#include "experiments/mrbsp/lost_pixels.h"
#include "experiments/stopwatch.h"
#include "renderers/frame_renderer.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"size", 1.0, "short sides",
                  "distance up to which the finest triangles are drawn; 0 fits it so that level of detail "
                  "alone draws the paper's share of triangles",
                  0, kFinest},
    ParameterSpec{"frames", std::int64_t{0}, "frames", "frames drawn and timed per method", 0, 240},
    ParameterSpec{"pictures", std::int64_t{0}, "views",
                  "views in which pixels lost by visibility are counted", 0, 240},
    ParameterSpec{"conservative", false, "",
                  "visibility that misses nothing instead of the paper's sampling"},
};

constexpr int kViews = 240, kRounds = 12;
constexpr double kPaperShare = 3008.0 / 7238;

enum Method { kBrute, kLod, kVis, kBoth, kMethods };
constexpr std::array<std::string_view, kMethods> kNames{"brute", "lod", "vis", "both"};

struct Methods {
  std::vector<Mrbsp> lods;

  Methods(const Heightfield& ground, bool conservative, Progress& progress) {
    const MrbspOptions options{.depth = depth_over(ground), .conforming = false};  // as printed
    MrbspOptions with_visibility = options;
    with_visibility.visibility = true;
    with_visibility.visible.mode =
        conservative ? visibility::Mode::kConservative : visibility::Mode::kSampled;
    lods.reserve(kMethods);
    lods.emplace_back(ground, options, progress);
    lods.emplace_back(ground, options, progress);
    lods.emplace_back(ground, with_visibility, progress);
    lods.emplace_back(ground, options, lods[kVis].visibility(), progress);
    for (Mrbsp& lod : lods) lod.tune(kFinest);
  }
  void tune(double size) {
    lods[kLod].tune(size);
    lods[kBoth].tune(size);
  }
};

// The number of all triangles, those outside the view included.
std::size_t triangles_unculled(const Heightfield& ground, const View& view, Progress& progress) {
  Mrbsp lod(ground, {.depth = depth_over(ground), .cull = false}, progress);
  lod.tune(kFinest);
  return lod.update(view).stats.triangles;
}

// The size at which level of detail alone draws the paper's share of brute force.
double fitted_size(Methods& methods, const std::vector<View>& views) {
  const double wanted = kPaperShare * mean_triangles(methods.lods[kBrute], views);
  double low = 1.0 / 64, high = kFinest;
  for (int step = 0; step < 24; ++step) {
    const double middle = std::sqrt(low * high);
    methods.tune(middle);
    (mean_triangles(methods.lods[kLod], views) < wanted ? low : high) = middle;
  }
  return high;
}

void count_triangles(Methods& methods, const std::vector<View>& views, Recorder& recorder) {
  std::array<double, kMethods> sums{};
  // Numbers of views in which brute force draws more than every other method; in which both together draw
  // fewer than either alone; in which they draw as many as the lesser of the two.
  std::size_t brute_most = 0, both_least = 0, tied = 0;
  for (const View& view : views) {
    std::array<std::size_t, kMethods> drawn{};
    for (std::size_t m = 0; m < kMethods; ++m) {
      drawn[m] = methods.lods[m].update(view).stats.triangles;
      sums[m] += static_cast<double>(drawn[m]);
      recorder.add(fmt::format("triangles_{}", kNames[m]), "", drawn[m]);
    }
    const auto [less, more] = std::minmax(drawn[kLod], drawn[kVis]);
    brute_most += more < drawn[kBrute];
    both_least += drawn[kBoth] < less;
    tied += drawn[kBoth] == less;
  }
  for (std::size_t m = 0; m < kMethods; ++m) {
    recorder.add(fmt::format("mean_{}", kNames[m]), "", sums[m] / static_cast<double>(views.size()));
    recorder.add(fmt::format("share_{}", kNames[m]), "", sums[m] / sums[kBrute]);
  }
  recorder.add("views", "", views.size());
  recorder.add("views_brute_most", "", brute_most);
  recorder.add("views_both_least", "", both_least);
  recorder.add("views_tied", "", tied);
}

// `count` views, evenly spaced over the walk.
std::vector<View> some_of(const std::vector<View>& views, std::size_t count) {
  std::vector<View> some;
  some.reserve(count);
  for (std::size_t k = 0; k < count; ++k) some.push_back(views[k * views.size() / count]);
  return some;
}

// Counts pixels lost because visibility leaves out triangles, with level of detail and without.
void count_lost_pixels(Methods& methods, const std::vector<View>& views, const RunOptions& options,
                       Recorder& recorder, Progress& progress) {
  const auto context = open_context(options.renderer, views[0].width, views[0].height);
  for (const auto& [whole, hiding] : {std::pair{kBrute, kVis}, {kLod, kBoth}}) {
    FrameRenderer of_all(*context), of_some(*context);
    std::size_t ground = 0, lost = 0, most_lost = 0, most_open = 0, open_views = 0;
    progress.begin("counting lost pixels", views.size());
    for (View view : views) {
      view.near = kWalkersNear;
      const LostPixels pixels = lost_pixels(methods.lods[whole].update(view), of_all,
                                            methods.lods[hiding].update(view), of_some, view);
      ground += pixels.ground;
      lost += pixels.lost;
      most_lost = std::max(most_lost, pixels.lost);
      most_open = std::max(most_open, pixels.open);
      open_views += pixels.open > 0;
      progress.advance();
    }
    progress.end();
    const double picture = static_cast<double>(views[0].width) * views[0].height;
    const double all = picture * static_cast<double>(views.size());
    const auto add = [&](std::string_view metric, std::string_view unit, double value) {
      recorder.add(fmt::format("{}_{}", metric, kNames[hiding]), unit, value);
    };
    add("ground_share", "", static_cast<double>(ground) / all);
    add("lost_share", "", static_cast<double>(lost) / all);
    add("most_lost_share", "", static_cast<double>(most_lost) / picture);
    add("most_lost", "px", most_lost);
    add("most_open", "px", most_open);
    add("open_views", "", open_views);
  }
  recorder.add("pictures", "", views.size());
}

// Time to update the flags of visibility along the walk, relative to choosing triangles without them.
void time_flags(Methods& methods, const Heightfield& ground, const std::vector<View>& views,
                Recorder& recorder) {
  const visibility::ChangeTable& table = methods.lods[kVis].visibility();
  visibility::Flags flags(table);
  double flag_time = 0, lod_time = 0;
  std::size_t toggled = 0;
  for (const View& view : views) {
    const glm::ivec2 cell = cell_below(table.cells, ground, view.eye);
    flag_time += seconds([&] { toggled += flags.move_to(table, cell); });
    lod_time += seconds([&] { methods.lods[kLod].update(view); });
  }
  const auto frames = static_cast<double>(views.size());
  recorder.add("toggled_per_view", "", static_cast<double>(toggled) / frames);
  recorder.add("toggle_time", "s", flag_time / frames);
  recorder.add("toggle_to_lod_time", "", flag_time / lod_time);
}

// Methods alternate at every view, so that a slow period of the machine affects all alike; every second round
// reverses their order, so that none always follows the same other one and inherits its caches. They are
// compared within a round, over all views: a whole round may be slow without changing its ratios.
void time_frames(Methods& methods, const Heightfield& ground, const std::vector<View>& views,
                 const RunOptions& options, Recorder& recorder, Progress& progress) {
  const auto context = open_context(options.renderer, views[0].width, views[0].height);
  std::vector<std::unique_ptr<FrameRenderer>> renderers;
  for (std::size_t m = 0; m < kMethods; ++m) renderers.push_back(std::make_unique<FrameRenderer>(*context));
  const HeightRange range = height_range(ground);
  const FrameStyle style{.lowest = range.lowest, .highest = range.highest};
  progress.begin("drawing frames", static_cast<std::uint64_t>(kRounds) * views.size());
  for (int round = -1; round < kRounds; ++round) {
    std::array<double, kMethods> sums{};
    for (std::size_t v = 0; v < (round < 0 ? 1 : views.size()); ++v) {
      const View& view = views[v];
      for (std::size_t turn = 0; turn < kMethods; ++turn) {
        const std::size_t m = round % 2 == 0 ? turn : kMethods - 1 - turn;
        const double time = seconds([&] {
          renderers[m]->draw(methods.lods[m].update(view), view, style);
          renderers[m]->finish();
        });
        if (round < 0) continue;  // the first frames upload heights and compile shaders
        recorder.add(fmt::format("frame_time_{}", kNames[m]), "s", time);
        sums[m] += time;
      }
      if (round >= 0) progress.advance();
    }
    if (round < 0) continue;
    for (std::size_t m = 0; m < kMethods; ++m) {
      recorder.add(fmt::format("time_share_{}", kNames[m]), "", sums[m] / sums[kBrute]);
    }
    for (const auto& [of, to] : {std::pair{kVis, kLod}, {kBoth, kLod}, {kBoth, kVis}}) {
      recorder.add(fmt::format("time_{}_to_{}", kNames[of], kNames[to]), "", sums[of] / sums[to]);
    }
  }
  progress.end();
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, options.profile == Profile::kPaper)) {
    const auto add = [&](std::string_view name, double size, bool conservative, int frames, int pictures) {
      cases.push_back({fmt::format("{}/{}", ground, name),
                       {kSpecs,
                        {{"size", size},
                         {"conservative", conservative},
                         {"frames", std::int64_t{frames}},
                         {"pictures", std::int64_t{pictures}}}},
                       ground});
    };
    // Drawing a frame takes a hundred times as long as counting its triangles.
    const bool paper = options.profile == Profile::kPaper;
    const int pictures = paper ? kViews : 80;
    add("printed", 1, false, paper ? 12 : 0, 0);
    add("tuned", 0, false, paper ? 30 : ground == "drawing-257" ? 0 : 16, pictures);
    add("conservative", 0, true, 0, pictures);
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const std::vector<View> views = walk(ground, kViews);
  Methods methods(ground, at.parameters.flag("conservative"), progress);
  const double asked = at.parameters.number("size");
  const double size = asked > 0 ? asked : fitted_size(methods, views);
  methods.tune(size);
  recorder.add("size", "short sides", size);
  recorder.add("triangles_all", "", triangles_unculled(ground, views[0], progress));
  count_triangles(methods, views, recorder);
  for (const View& view : views) {
    recorder.add("lod_time", "s", seconds([&] { methods.lods[kLod].update(view); }));
    recorder.add("both_time", "s", seconds([&] { methods.lods[kBoth].update(view); }));
  }
  time_flags(methods, ground, views, recorder);
  const auto pictures = static_cast<std::size_t>(at.parameters.integer("pictures"));
  if (pictures > 0) count_lost_pixels(methods, some_of(views, pictures), options, recorder, progress);
  const auto frames = static_cast<std::size_t>(at.parameters.integer("frames"));
  if (frames > 0) time_frames(methods, ground, some_of(views, frames), options, recorder, progress);
}

}  // namespace

extern const Experiment kWalk{"mrbsp.walk", "Table 2: triangles and time of LOD, visibility and both", kSpecs,
                              cases, measure};

}  // namespace terrabench::mrbsp
