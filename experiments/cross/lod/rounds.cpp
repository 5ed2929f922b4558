#include "experiments/cross/lod/rounds.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "experiments/stopwatch.h"

namespace terrabench::cross {

void Rounds::sample(std::vector<std::string> metrics, std::string unit,
                    std::function<std::vector<double>()> work) {
  steps_.push_back({std::move(metrics), std::move(unit), std::move(work)});
}

void Rounds::sample(std::string metric, std::string unit, std::function<double()> work) {
  sample(std::vector{std::move(metric)}, std::move(unit),
         [work = std::move(work)] { return std::vector{work()}; });
}

void Rounds::time(std::string metric, std::function<void()> work) {
  sample(std::move(metric), "s", [work = std::move(work)] { return seconds(work); });
}

bool Rounds::do_round() {
  bool any = false;
  double before = loop_();
  for (Step& step : steps_) {
    if (!step.turns.more(static_cast<std::size_t>(most_rounds(step.spent, long_time_, few_)))) continue;
    any = true;
    const Stopwatch watch;
    std::vector<double> samples = step.work();
    const double all = watch.seconds();
    const double measured = step.unit == "s" ? std::accumulate(samples.begin(), samples.end(), 0.0) : all;
    step.spent = {std::max(step.spent.longest, measured), step.spent.all + all};
    const double after = loop_();
    step.turns.add(std::move(samples), std::max(before, after));
    before = after;
  }
  return any;
}

void Rounds::run(Recorder& recorder) {
  while (do_round()) {
  }
  std::size_t left_out = 0, disturbed = 0;
  for (const Step& step : steps_) {
    const auto kept = step.turns.kept(static_cast<std::size_t>(few_));
    for (const std::vector<double>& samples : kept) {
      for (std::size_t m = 0; m < samples.size(); ++m) recorder.add(step.metrics[m], step.unit, samples[m]);
    }
    left_out += step.turns.taken() - kept.size();
    disturbed += kept.size() - std::min(kept.size(), step.turns.undisturbed());
  }
  recorder.add_varying("left_out_samples", "", static_cast<double>(left_out));
  recorder.add_varying("disturbed_samples", "", static_cast<double>(disturbed));
  steps_.clear();
}

}  // namespace terrabench::cross
