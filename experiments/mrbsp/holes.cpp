// §3: holes that the one-vertex rule leaves, counted by the crack detector that all methods share.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/experiment.h"
#include "experiments/mrbsp/ground.h"
#include "lod/meters/cracks.h"

namespace terrabench::mrbsp {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"conforming", false, "", "the rule without holes instead of the paper's"},
    ParameterSpec{"area", false, "", "threshold M - 2 log2(D/S)"},
};
constexpr std::array kSizes{1.0, 4.0, 16.0};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options, true)) {
    for (const bool area : {false, true}) {
      for (const bool conforming : {false, true}) {
        cases.push_back(
            {fmt::format("{}/{}{}", ground, conforming ? "conforming" : "printed", area ? "-area" : ""),
             {kSpecs, {{"conforming", conforming}, {"area", area}}},
             ground});
      }
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const Heightfield& ground = *source.heights;
  Mrbsp lod(ground,
            {.depth = depth_over(ground),
             .area_consistent = at.parameters.flag("area"),
             .holes = at.parameters.flag("conforming") ? HoleRule::kConforming : HoleRule::kPrinted},
            progress);
  const std::vector<View> views = walk(ground, options.profile == Profile::kPaper ? 240 : 40);
  std::size_t holes = 0, torn = 0, drawn = 0;
  double largest_gap = 0;
  progress.begin("looking for holes", kSizes.size() * views.size());
  for (const double size : kSizes) {
    lod.tune(size);
    for (const View& view : views) {
      const Frame& frame = lod.update(view);
      const CrackReport report = find_cracks(frame, ground.width, ground.depth, view);
      drawn += frame.stats.triangles;
      torn += !report.tight();
      holes += report.gaps + report.bare_edges + report.overlaps;
      largest_gap = std::max(largest_gap, report.largest_gap_m);
      progress.advance();
    }
  }
  progress.end();
  const auto frames = static_cast<double>(kSizes.size() * views.size());
  recorder.add("frames", "", frames);
  recorder.add("triangles_per_frame", "", static_cast<double>(drawn) / frames);
  recorder.add("holes", "", holes);
  recorder.add("frames_with_holes", "", torn);
  recorder.add("largest_gap", "m", largest_gap);
}

}  // namespace

extern const Experiment kHoles{"mrbsp.holes", "§3: holes that the rules leave", kSpecs, cases, measure};

}  // namespace terrabench::mrbsp
