// Table 2: triangles that each of the four methods draws along one walk, time per frame, and time to choose
// the triangles. All methods get the same views.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/mrbsp/lost_pixels.h"
#include "experiments/mrbsp/methods.h"
#include "experiments/stopwatch.h"
#include "renderers/frame_renderer.h"

namespace terrabench::mrbsp {
namespace {

const std::array kSpecs{
    ParameterSpec{"size", 1.0, "short sides",
                  "distance up to which the finest triangles are drawn; 0 fits it so that level of detail "
                  "alone draws the paper's share of triangles",
                  0, kFinest},
    ParameterSpec{"frames", std::int64_t{0}, "frames", "frames drawn and timed per method", 0, 240},
    ParameterSpec{"pictures", std::int64_t{0}, "views",
                  "views in which pixels lost by visibility are counted", 0, 240},
    choice("sets", visibility::kModeNames, "how the visible sets are computed"),
    ParameterSpec{"cells", std::int64_t{16}, "cells",
                  "largest number along the longer side; 0 fits it so that visibility alone draws about the "
                  "paper's share of triangles",
                  0, 256},
};

constexpr int kViews = 240;
constexpr std::int64_t kCellsAlong = 16;  // our choice: the paper gives no number
// Few views would not represent the walk: of 12, LOD and VIS draw almost the same number of triangles.
constexpr int kTimedViews = 36;
// A view with a larger share of lost pixels shows an anomaly: at 800 × 600, a patch of 70 × 70 pixels.
constexpr double kApparent = 0.01;

// The number of all triangles, those outside the view included.
std::size_t triangles_unculled(const Heightfield& ground, const View& view, Progress& progress) {
  Mrbsp lod(ground, {.depth = depth_over(ground), .cull = false}, progress);
  lod.tune(kFinest);
  return lod.update(view).stats.triangles;
}

void count_triangles(Methods& methods, const std::vector<View>& views, Recorder& recorder) {
  std::array<double, kMethods> sums{};
  recorder.add("views", "", views.size());
  for (std::size_t m = 0; m < kMethods; ++m) {
    for (const View& view : views) sums[m] += methods.lods[m].update(view).stats.triangles;
    recorder.add(fmt::format("mean_{}", kMethodNames[m]), "", sums[m] / views.size());
    if (m != kBrute) recorder.add(fmt::format("share_{}", kMethodNames[m]), "", sums[m] / sums[kBrute]);
  }
}

// Counts pixels lost because visibility leaves out triangles, with level of detail and without.
void count_lost_pixels(Methods& methods, const std::vector<View>& views, const RunOptions& options,
                       Recorder& recorder, Progress& progress) {
  const auto context = open_context(options.renderer, views[0].width, views[0].height);
  for (const auto& [whole, hiding] : {std::pair{kBrute, kVis}, {kLod, kBoth}}) {
    FrameRenderer of_all(*context), of_some(*context);
    std::size_t ground = 0, lost = 0, most_lost = 0, most_open = 0, open_views = 0, apparent = 0;
    double most_share = 0;
    progress.begin("counting lost pixels", views.size());
    for (View view : views) {
      view.near = kWalkersNear;
      const LostPixels pixels = lost_pixels(methods.lods[whole].update(view), of_all,
                                            methods.lods[hiding].update(view), of_some, view);
      const double lost_here = share(pixels.lost, pixels.ground);
      ground += pixels.ground;
      lost += pixels.lost;
      most_lost = std::max(most_lost, pixels.lost);
      most_share = std::max(most_share, lost_here);
      most_open = std::max(most_open, pixels.open);
      open_views += pixels.open > 0;
      apparent += lost_here > kApparent;
      progress.advance();
    }
    progress.end();
    const double all = static_cast<double>(views[0].width) * views[0].height * views.size();
    const auto add = [&](std::string_view metric, std::string_view unit, double value) {
      recorder.add(fmt::format("{}_{}", metric, kMethodNames[hiding]), unit, value);
    };
    if (hiding == kVis) add("ground_share", "", static_cast<double>(ground) / all);
    add("lost_share", "", share(lost, ground));
    add("most_lost_share", "", most_share);
    add("apparent_share", "", share(apparent, views.size()));
    add("most_lost", "px", most_lost);
    add("most_open", "px", most_open);
    add("open_views", "", open_views);
  }
  recorder.add("pictures", "", views.size());
}

// Processor time to update the flags of visibility along the walk, relative to choosing triangles without
// them.
void time_flags(Methods& methods, const Heightfield& ground, const std::vector<View>& views,
                Recorder& recorder) {
  const visibility::ChangeTable& table = methods.lods[kVis].visibility();
  visibility::Flags flags(table);
  std::vector<glm::ivec2> cells;
  for (const View& view : views) cells.push_back(cell_below(table.cells, ground, view.eye));
  std::size_t toggled = 0;
  const double flag_time = processor_seconds([&] {
    for (const glm::ivec2 cell : cells) toggled += flags.move_to(table, cell);
  });
  const double lod_time = processor_seconds([&] {
    for (const View& view : views) methods.lods[kLod].update(view);
  });
  recorder.add("toggled_per_view", "", static_cast<double>(toggled) / static_cast<double>(views.size()));
  recorder.add_varying("toggle_to_lod_time", "", flag_time / lod_time);
}

void record_times(Methods& methods, const Heightfield& ground, const std::vector<View>& views,
                  const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::vector<FrameTimes> times = time_frames(methods.lods, ground, views, options, progress);
  for (std::size_t m = 0; m < kMethods; ++m) {
    const std::string_view name = kMethodNames[m];
    for (const double time : times[m].rounds) recorder.add(fmt::format("frame_time_{}", name), "s", time);
    recorder.add_varying(fmt::format("least_time_share_{}", name), "", times[m].least / times[kBrute].least);
  }
  recorder.add_varying("lod_frame_share", "", times[kLod].choosing_share);
}

// A picture from above, in which every triangle covers some pixels: the number of triangles that it shows.
std::size_t triangles_shown(const Heightfield& ground, const RunOptions& options, Progress& progress) {
  constexpr int kPixels = 2048;
  Mrbsp lod(ground, {.depth = depth_over(ground), .cull = false}, progress);
  lod.tune(kFinest);
  const float extent = std::max(ground.extent_x(), ground.extent_z());
  View view;
  view.target = {ground.extent_x() / 2, 0, ground.extent_z() / 2};
  view.eye = view.target + glm::vec3(0, 20 * extent, 0);
  view.up = {0, 0, -1};
  view.vertical_fov = 2 * std::atan(0.52F / 20);
  view.width = view.height = kPixels;
  view.near = 10 * extent;
  view.far = 30 * extent;
  const auto context = open_context(options.renderer, kPixels, kPixels);
  const Frame& frame = lod.update(view);
  std::vector<std::uint32_t> numbers = FrameRenderer(*context).triangle_numbers(frame, view);
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers.size() - (numbers.front() == 0 ? 1 : 0);
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  const bool paper = options.profile == Profile::kPaper;
  for (const std::string& ground : grounds(options, true)) {
    const auto add = [&](std::string_view name, double size, visibility::Mode sets, std::int64_t cells,
                         int frames, int pictures) {
      cases.push_back({fmt::format("{}/{}", ground, name),
                       {kSpecs,
                        {{"size", size},
                         {"sets", std::string(name_of(sets))},
                         {"cells", cells},
                         {"frames", std::int64_t{frames}},
                         {"pictures", std::int64_t{pictures}}}},
                       ground});
    };
    // Drawing a frame takes a hundred times as long as counting its triangles.
    const int pictures = paper ? kViews : ground == "rough-257" ? 0 : 40;
    const int frames = paper || ground == kPapersGround ? kTimedViews : 0;
    add("printed", 1, visibility::Mode::kSampled, kCellsAlong, frames, 0);
    add("matched", 0, visibility::Mode::kSampled, 0, frames, 0);
    add("fitted", 0, visibility::Mode::kSampled, kCellsAlong, 0, pictures);
    for (const visibility::Mode sets : {visibility::Mode::kVertices, visibility::Mode::kFacing,
                                        visibility::Mode::kInterior, visibility::Mode::kConservative}) {
      // Of the other readings at most a third of the walk, and in quick on one ground.
      const bool safe = sets == visibility::Mode::kConservative;
      add(name_of(sets), 0, sets, kCellsAlong, 0,
          safe                      ? pictures
          : paper                   ? kViews / 3
          : ground == kPapersGround ? pictures
                                    : 0);
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const std::vector<View> views = walk(ground, kViews);
  const visibility::Options how{.mode = static_cast<visibility::Mode>(at.parameters.choice("sets")),
                                .cells = at.integer("cells")};
  const visibility::ChangeTable sets =
      how.cells > 0 ? sets_over(ground, how, progress) : fitted_sets(ground, how, views, progress);
  Methods methods(ground, sets, progress);
  const double asked = at.parameters.number("size");
  const double size = asked > 0 ? asked : fitted_size(methods, views);
  methods.tune(size);
  recorder.add("size", "short sides", size);
  recorder.add("cells", "", std::max(sets.cells.columns, sets.cells.rows));
  recorder.add("triangles_all", "", triangles_unculled(ground, views[0], progress));
  count_triangles(methods, views, recorder);
  for (const View& view : views)
    recorder.add_frame("lod_time", "s", seconds([&] { methods.lods[kLod].update(view); }));
  time_flags(methods, ground, views, recorder);
  const auto pictures = static_cast<std::size_t>(at.parameters.integer("pictures"));
  if (pictures > 0) {
    recorder.add("triangles_shown", "", triangles_shown(ground, options, progress));
    count_lost_pixels(methods, some_of(views, pictures), options, recorder, progress);
  }
  const auto frames = static_cast<std::size_t>(at.parameters.integer("frames"));
  if (frames > 0) record_times(methods, ground, some_of(views, frames), options, recorder, progress);
}

}  // namespace

extern const Experiment kWalk{"mrbsp.walk", "Table 2: triangles and time of LOD, visibility and both",
                              kSpecs,       cases,
                              measure,      Experiment::kTimed};

}  // namespace terrabench::mrbsp
