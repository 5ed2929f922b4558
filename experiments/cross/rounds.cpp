#include "experiments/cross/rounds.h"

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

void Rounds::run(Recorder& recorder) {
  for (int round = 0; round < kMost; ++round) {
    for (Step& step : steps_) {
      if (round >= most_rounds(step.spent, long_time_, few_)) continue;
      const Stopwatch watch;
      const std::vector<double> samples = step.work();
      const double all = watch.seconds();
      const double measured = step.unit == "s" ? std::accumulate(samples.begin(), samples.end(), 0.0) : all;
      step.spent = {std::max(step.spent.longest, measured), step.spent.all + all};
      for (std::size_t m = 0; m < samples.size(); ++m) recorder.add(step.metrics[m], step.unit, samples[m]);
    }
  }
  steps_.clear();
}

}  // namespace terrabench::cross
