#include "experiments/samples.h"

#include <utility>

#include "experiments/stopwatch.h"

namespace terrabench {

void Samples::add(std::vector<std::string> metrics, std::string unit,
                  std::function<std::vector<double>()> work) {
  pieces_.push_back({std::move(metrics), std::move(unit), std::move(work)});
}

void Samples::add(std::string metric, std::string unit, std::function<double()> work) {
  add(std::vector{std::move(metric)}, std::move(unit),
      [work = std::move(work)] { return std::vector{work()}; });
}

void Samples::time(std::string metric, std::function<void()> work) {
  add(std::move(metric), "s", [work = std::move(work)] { return seconds(work); });
}

void Samples::take(Recorder& recorder) {
  for (bool any = true; any;) {
    any = false;
    for (Piece& piece : pieces_) {
      if (!piece.repetitions.more()) continue;
      any = true;
      const Stopwatch watch;
      const std::vector<double> samples = piece.work();
      piece.repetitions.add(watch.seconds());
      for (std::size_t m = 0; m < samples.size(); ++m) {
        recorder.add(piece.metrics[m], piece.unit, samples[m]);
      }
    }
  }
  pieces_.clear();
}

}  // namespace terrabench
