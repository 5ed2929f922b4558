// How times are sampled: the pieces of work of a case in turn, each six times. A machine that others share is
// slow for some tenths of a second at a time; samples taken one after the other would all be slow, or none,
// and their confidence interval would not show it. differ() (results/store/statistics.h) says which of two
// sampled times may be called the longer one.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/recorder.h"

namespace terrabench {

// With three samples in each of two runs, all samples of one run are longer than all of the other's in one
// case of ten although nothing changed; with six in one of 462.
inline constexpr int kSamples = 6;

// How often one piece of work is called: kSamples times, or fewer where the calls take longer than `seconds`
// together, but at least once.
class Repetitions {
 public:
  // By default only work of more than a second per call has fewer than kSamples.
  explicit Repetitions(double seconds = kSamples) : seconds_(seconds) {}
  bool more() const { return taken_ == 0 || (taken_ < kSamples && spent_ < seconds_); }
  void add(double seconds) {
    ++taken_;
    spent_ += seconds;
  }

 private:
  double seconds_, spent_ = 0;
  int taken_ = 0;
};

// The pieces of work of one case.
class Samples {
 public:
  // Adds metrics of one unit. `work` returns a sample of each.
  void add(std::vector<std::string> metrics, std::string unit, std::function<std::vector<double>()> work);
  void add(std::string metric, std::string unit, std::function<double()> work);
  void time(std::string metric, std::function<void()> work);  // the seconds that it takes

  // Calls each piece of work once per round until its Repetitions end (their time limit includes what it
  // prepares), records the samples and discards the work. What the work refers to must still exist.
  void take(Recorder&);

 private:
  struct Piece {
    std::vector<std::string> metrics;
    std::string unit;
    std::function<std::vector<double>()> work;
    Repetitions repetitions = Repetitions();
  };
  std::vector<Piece> pieces_;
};

}  // namespace terrabench
