// Every cost against the size of the ground: structures over height maps and over a solid, level-of-detail
// methods along a walk, and flow routing. The ground of height maps grows as a window on endless hills does,
// with the same work per column; the solid is one cube of caves at finer and finer resolution. The theory of
// each family, and what it measures, is in GrowthTheory, LodGrowth and measure_flow().
#include <fmt/format.h>

#include <array>

#include "experiments/cases.h"
#include "experiments/cross/scale/run.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "lod/lod.h"
#include "terrain/files.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::cross {
namespace {

constexpr std::array<std::string_view, 4> kFamilies{"heights", "solids", "lods", "flow"};
constexpr std::string_view kWholeMetres = "whole_metres", kUnrounded = "unrounded";

const std::array kSpecs{
    choice("family", kFamilies, "what is measured: structures over heights or solids, methods, flow routing"),
    ParameterSpec{"method", std::string("heightmap"), "",
                  "a name of `terrabench list`; for flow, whole_metres or unrounded"},
    ParameterSpec{"smallest", std::int64_t{129}, "samples", "side of the smallest ground", 8, 32769},
    ParameterSpec{"largest", std::int64_t{1025}, "samples", "side of the largest ground", 8, 32769},
    ParameterSpec{"seconds", 4.0, "s", "processor time for all sizes; a size that would exceed it is skipped",
                  0, 1e6},
    ParameterSpec{"memory", 20.0, "GiB", "largest heap; a size that would exceed it is skipped", 0.001, 1e6},
    ParameterSpec{"pixels", 2.0, "px", "screen-space error of the methods", 0.05, 200},
};

// Whole metres are sorted into buckets, in O(n); heights as they are need a heap, in O(n log n).
void measure_flow(const Run& run, bool whole) {
  SizePlan plan = run.plan("route", 1, {1, 1});
  Cost route("route", "s", 1, !whole);
  run.at_each_side(whole ? "flow over whole metres" : "flow over unrounded heights", false, [&](int side) {
    const double columns = squared(side);
    run.measured(plan, columns, [&] {
      Heightfield ground = noise_hills(side, run.seed());
      if (whole) ground = whole_metres(std::move(ground));
      FlowNetwork network;
      run.add_samples(
          route, columns, [&] { network = {}; }, [&] { network = route_flow(ground); });
    });
  });
  plan.record(run.recorder());
  route.record(run.recorder());
}

// The limit of processor time per case, in seconds. With these limits all cases took 23 minutes on two cores
// of an AMD EPYC. A size that is expected to exceed the limit is skipped, and the record gives time as the
// reason: the mesh of the largest implicit surface, and on slow machines the largest voxels over heights.
double budget(std::string_view family) { return family == "heights" ? 300 : family == "solids" ? 150 : 120; }

std::vector<Case> cases(const RunOptions&) {
  std::vector<Case> cases;
  const auto add = [&](std::string_view family, std::string_view method, std::int64_t smallest,
                       std::int64_t largest) {
    cases.push_back({fmt::format("{}/{}", family, method),
                     {kSpecs,
                      {{"family", std::string(family)},
                       {"method", std::string(method)},
                       {"smallest", smallest},
                       {"largest", largest},
                       {"seconds", budget(family)}}}});
  };
  for (const std::string_view one : scaled_structures(false)) add("heights", one, 129, 16385);
  for (const std::string_view one : scaled_structures(true)) add("solids", one, 32, 1024);
  for (const LodType& one : lods()) add("lods", one.name, 129, 16385);
  for (const std::string_view one : {kWholeMetres, kUnrounded}) add("flow", one, 129, 16385);
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Run run(at, options, recorder, progress);
  const std::string &family = at.parameters.text("family"), &method = at.parameters.text("method");
  if (family == "solids") {
    recorder.terrain(open_terrain("caves", options.seed));
    measure_structure(run, true, method);
    return;
  }
  recorder.terrain("noise-hills", checksum(fmt::format("noise-hills {}", options.seed)));
  if (family == "heights") measure_structure(run, false, method);
  if (family == "lods") measure_lod(run, method);
  if (family == "flow") {
    constexpr std::array<std::string_view, 2> kKnown{kWholeMetres, kUnrounded};
    if (std::ranges::count(kKnown, method) == 0) throw unknown_name("kind of heights", method, kKnown);
    measure_flow(run, method == kWholeMetres);
  }
}

}  // namespace

extern const Experiment kScale{.id = "cross.scale",
                               .title = "Every cost against the size of the ground",
                               .parameters = kSpecs,
                               .cases = cases,
                               .measure = measure,
                               .kind = Experiment::kOwnProcess,
                               .profile_scale = true};

}  // namespace terrabench::cross
