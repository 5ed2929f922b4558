#include "experiments/cross/rounds.h"

#include <algorithm>
#include <utility>

#include "experiments/stopwatch.h"

namespace terrabench::cross {

void Rounds::sample(std::string metric, std::string unit, std::function<double()> work) {
  steps_.push_back({std::move(metric), std::move(unit), std::move(work)});
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
      recorder.add(step.metric, step.unit, step.work());
      step.longest = std::max(step.longest, watch.seconds());
      step.all += watch.seconds();
    }
  }
}

}  // namespace terrabench::cross
