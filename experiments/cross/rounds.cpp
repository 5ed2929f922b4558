#include "experiments/cross/rounds.h"

#include <algorithm>
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

void Rounds::run(Recorder& recorder) {
  for (int round = 0; round < kMost; ++round) {
    for (Step& step : steps_) {
      const int rounds = step.longest > long_time_ ? 1 : step.all > long_time_ ? kFew : kMost;
      if (round >= rounds) continue;
      const Stopwatch watch;
      const std::vector<double> samples = step.work();
      step.longest = std::max(step.longest, watch.seconds());
      step.all += watch.seconds();
      for (std::size_t m = 0; m < samples.size(); ++m) recorder.add(step.metrics[m], step.unit, samples[m]);
    }
  }
  steps_.clear();
}

}  // namespace terrabench::cross
