// How long cases took in the reference run, on two cores: results/reference/durations.csv.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "experiments/runner.h"
#include "results/claims/embedded.h"
#include "terrain/number.h"

namespace terrabench {
namespace {

// Lines "seconds,profile,experiment,case", of which only the case's name may hold a comma.
std::map<std::string, double> read() {
  std::map<std::string, double> seconds;
  std::string_view text = embedded_durations().front().text;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) continue;
    if (const auto number = parse_number<double>(line.substr(0, comma)))
      seconds[std::string(line.substr(comma + 1))] = *number;
  }
  return seconds;
}

double reference_seconds(const RunPlan& plan, const PlannedCase& planned) {
  static const std::map<std::string, double> kSeconds = read();
  // Cases of the profile scale are listed under paper.
  const std::string_view kept = plan.options.profile == Profile::kQuick ? "quick" : "paper";
  const auto at = kSeconds.find(fmt::format("{},{},{}", kept, planned.experiment->id, planned.at.name));
  return at == kSeconds.end() ? 0 : at->second;
}

}  // namespace

double expected_seconds(const RunPlan& plan, const PlannedCase& planned) {
  const double alone = plan.seconds ? plan.seconds(planned) : reference_seconds(plan, planned);
  const Experiment& experiment = *planned.experiment;
  const bool beside = experiment.kind != Experiment::kOwnProcess && !experiment.timed(planned.at);
  return beside ? alone / plan.jobs : alone;
}

}  // namespace terrabench
