// §4: smaller cells make a frame faster, since their sets are closer to what is visible. All sizes of cells
// are timed in turns, with the same views; the quick profile counts triangles alone.
#include <fmt/format.h>

#include <array>

#include "experiments/experiment.h"
#include "experiments/mrbsp/methods.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"views", std::int64_t{36}, "views", "timed, evenly spaced over the walk of table 2", 0,
                  240},
};
constexpr int kViews = 240;

std::vector<Case> cases(const RunOptions& options) {
  const std::int64_t views = options.profile == Profile::kPaper ? 36 : 0;
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, true)) {
    cases.push_back({ground, {kSpecs, {{"views", views}}}, ground});
  }
  return cases;
}

bool times(const Case& at) { return at.parameters.integer("views") > 0; }

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  MrbspOptions how{.depth = depth_over(ground), .holes = HoleRule::kPrinted};
  std::vector<Mrbsp> lods;  // brute force, then by number of cells
  lods.reserve(1 + kCells.size());
  lods.emplace_back(ground, how, progress);
  how.visibility = true;
  how.visible.mode = visibility::Mode::kSampled;
  for (const int cells : kCells) {
    how.visible.cells = cells;
    lods.emplace_back(ground, how, progress);
  }
  const std::vector<View> all = walk(ground, kViews);
  for (Mrbsp& lod : lods) lod.tune(kFinest);
  const double brute = mean_triangles(lods[0], all);
  for (std::size_t k = 0; k < kCells.size(); ++k) {
    recorder.add(fmt::format("share_{}", kCells[k]), "", mean_triangles(lods[k + 1], all) / brute);
  }
  if (!times(at)) return;
  const std::vector<View> views = some_of(all, static_cast<std::size_t>(at.parameters.integer("views")));
  const std::vector<FrameTimes> times = time_frames(lods, ground, views, options, progress);
  for (std::size_t k = 0; k < kCells.size(); ++k) {
    recorder.add_varying(fmt::format("least_time_share_{}", kCells[k]), "",
                         times[k + 1].least / times[0].least);
  }
}

}  // namespace

extern const Experiment kCellSizes{"mrbsp.cells", "§4: time per frame against the size of the cells",
                                   kSpecs,        cases,
                                   measure,       Experiment::kTimed,
                                   times};

}  // namespace terrabench::mrbsp
