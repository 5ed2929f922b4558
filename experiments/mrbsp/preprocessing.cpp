// §4: the time to find the visible sets against the number of cells and the coarseness of their triangles.
// Processor times on one thread, so that a busy machine does not change their ratios.
#include <fmt/format.h>

#include <array>

#include "experiments/mrbsp/ground.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/visibility/sets.h"

namespace terrabench::mrbsp {
namespace {

struct Setting {
  int cells, coarseness;
};
constexpr std::array kSettings{Setting{16, 4}, Setting{16, 6}, Setting{16, 8}, Setting{32, 6},
                               Setting{64, 6}};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, options.profile == Profile::kPaper)) {
    cases.push_back({ground, Parameters(), ground});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const BisectionTree tree = BisectionTree::over(ground.width, ground.depth, depth_over(ground));
  Samples times;
  for (const auto& [cells, coarseness] : kSettings) {
    const visibility::Options how{
        .mode = visibility::Mode::kSampled, .cells = cells, .coarseness = coarseness};
    times.add(fmt::format("time_cells_{}_coarseness_{}", cells, coarseness), "s", [&, how] {
      return processor_seconds([&] { find_sets(grid_of(ground), tree, how, progress); });
    });
  }
  times.take(recorder);
}

}  // namespace

extern const Experiment kPreprocessing{
    "mrbsp.preprocessing", "§4: time to find the visible sets", {}, cases, measure, Experiment::kTimed};

}  // namespace terrabench::mrbsp
