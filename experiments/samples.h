// How times are sampled: the pieces of work of a case in turn, each six times. A machine that others share is
// slow for some tenths of a second at a time; samples taken one after the other would all be slow, or none,
// and their confidence interval would not show it. relation() (results/store/statistics.h) says which of two
// sampled times may be called the longer one.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/recorder.h"
#include "results/store/statistics.h"

namespace terrabench {

inline constexpr int kSamples = kFewestSamples;

// How often one piece of work is called: kSamples times, or once if the first call takes longer than
// `longest` seconds. Two to five samples would give no interval, and take longer than one.
class Repetitions {
 public:
  explicit Repetitions(double longest = 10) : longest_(longest) {}
  bool more() const { return taken_ < wanted_; }
  void add(double seconds) {
    if (++taken_ == 1 && seconds > longest_) wanted_ = 1;
  }

 private:
  double longest_;
  int wanted_ = kSamples, taken_ = 0;
};

// The pieces of work of one case.
class Samples {
 public:
  // Adds metrics of one unit. `work` returns a sample of each.
  void add(std::vector<std::string> metrics, std::string unit, std::function<std::vector<double>()> work);
  void add(std::string metric, std::string unit, std::function<double()> work);
  void time(std::string metric, std::function<void()> work);  // the seconds that it takes

  // Calls each piece of work once per round until its Repetitions end (whose limit includes what it
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
