// The averaged Hausdorff distance of the drill paper's equation 3 in each reading: which lie in the paper's
// range, which exceed 1 as §3.1 says is possible, and which rise with τ.
#include <fmt/format.h>

#include "experiments/drill/analysis.h"
#include "experiments/drill/ground.h"
#include "experiments/experiment.h"

namespace terrabench::drill {
namespace {

// The names of kReadings, in its order.
constexpr std::array<std::string_view, kReadings.size()> kReadingNames{
    "mean-plane",    "mean-plane-samples",    "mean-space",    "mean-space-samples",
    "largest-plane", "largest-plane-samples", "largest-space", "largest-space-samples",
    "sum-plane",     "sum-plane-samples",     "sum-space",     "sum-space-samples"};

const std::array kSpecs{
    variant_parameter(),
    choice("reading", kReadingNames, "how distances are averaged, and in which space they are taken"),
};

// The ground comes last, so that a claim about a reading is judged on the claims' ground alone: twelve
// readings of three variants are many rows, and tables show them on the other grounds.
std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& ground : grounds(options)) {
    for (const Variant& variant : kVariants) {
      for (const Reading& reading : kReadings) {
        cases.push_back({fmt::format("{}/{}/{}", variant.name, reading.name(), ground),
                         {kSpecs, {{"variant", std::string(variant.name)}, {"reading", reading.name()}}},
                         ground});
      }
    }
  }
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_ground(at.terrain, options.seed));
  const std::vector<Outcome>& outcomes = factorial_of(source, variant_of(at.parameters), progress);
  const std::size_t reading = at.parameters.choice("reading");
  record_error(
      outcomes, "", [=](const Outcome& o) { return o.ahd[reading]; }, recorder);
}

}  // namespace

extern const Experiment kAhdReadings{"drill.readings", "§3: the readings of the averaged Hausdorff distance",
                                     kSpecs, cases, measure};

}  // namespace terrabench::drill
