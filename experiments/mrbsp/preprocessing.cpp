// §4: the time to find the visible sets against the number of cells and the coarseness of their triangles.
// All settings take turns; times are processor times on one thread, so that a busy machine does not change
// their ratios.
#include <fmt/format.h>

#include <array>

#include "experiments/experiment.h"
#include "experiments/mrbsp/ground.h"
#include "experiments/stopwatch.h"
#include "lod/mrbsp/bisection_tree.h"
#include "lod/mrbsp/visibility/sets.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"samples", std::int64_t{6}, "samples", "times that each setting is measured", 1, 100},
};
struct Setting {
  int cells, coarseness;
};
constexpr std::array kSettings{Setting{16, 4}, Setting{16, 6}, Setting{16, 8}, Setting{32, 6},
                               Setting{64, 6}};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, options.profile == Profile::kPaper)) {
    cases.push_back({ground, Parameters(kSpecs), ground});
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  const BisectionTree tree = BisectionTree::over(ground.width, ground.depth, depth_over(ground));
  const int samples = at.integer("samples");
  for (int sample = 0; sample < samples; ++sample) {
    for (const auto& [cells, coarseness] : kSettings) {
      const visibility::Options how{
          .mode = visibility::Mode::kSampled, .cells = cells, .coarseness = coarseness};
      recorder.add(fmt::format("time_cells_{}_coarseness_{}", cells, coarseness), "s",
                   processor_seconds([&] { find_sets(grid_of(ground), tree, how, progress); }));
    }
  }
}

}  // namespace

extern const Experiment kPreprocessing{
    "mrbsp.preprocessing", "§4: time to find the visible sets", kSpecs, cases, measure, Experiment::kTimed};

}  // namespace terrabench::mrbsp
