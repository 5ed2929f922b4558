// Times of several pieces of work, taken in rounds: each piece once a round. A machine that others share is
// slow for some tenths of a second at a time; samples taken one after the other would all be slow, or none,
// and their confidence interval would not show it. Samples that other work disturbed (interference.h) are
// taken again.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/interference.h"
#include "experiments/recorder.h"

namespace terrabench::cross {

class Rounds {
 public:
  // With three samples in each of two runs, an unchanged time looks changed (all samples of one run above all
  // of the other's) in one case of ten, with six in one of 462. So kMost are taken, and kFew only where the
  // work is long. Further samples taken right then would help less than a second measurement later
  // (second_look.h).
  static constexpr int kMost = 6, kFew = 3;

  // Seconds that a piece of work took so far. `longest`: its longest call, and of metrics in seconds only
  // what was measured, summed over the metrics. `all`: all calls, with what they did to prepare.
  struct Spent {
    double longest = 0, all = 0;
  };
  // How many samples a piece gets, at least those that it has: one if a call took longer than `long_time`, or
  // all calls longer than kPatience times that; `few` if all calls took longer than `long_time`; else kMost.
  static constexpr double kPatience = 30;
  static constexpr int most_rounds(const Spent& spent, double long_time, int few = kFew) {
    if (spent.longest > long_time || spent.all > kPatience * long_time) return 1;
    return spent.all > long_time ? few : kMost;
  }

  // `long_time`: seconds. `few`: 1 to kMost. `loop`: as loop_seconds().
  explicit Rounds(double long_time = 1, int few = kFew, std::function<double()> loop = loop_seconds)
      : long_time_(long_time), few_(few), loop_(std::move(loop)) {}

  // Adds metrics of one unit. `work` is called once a round and returns a sample of each.
  void sample(std::vector<std::string> metrics, std::string unit, std::function<std::vector<double>()> work);
  void sample(std::string metric, std::string unit, std::function<double()> work);
  void time(std::string metric, std::function<void()> work);  // the seconds that it takes

  // Does each piece of work kMost times, or as often as most_rounds() allows, and repeats disturbed samples
  // up to the same number again. Records the undisturbed samples of a piece if they are at least `few`,
  // otherwise all; and the numbers of samples left out and of disturbed ones kept, as left_out_samples and
  // disturbed_samples. What the work refers to must still be there. Then forgets the work.
  void run(Recorder&);

 private:
  struct Step {
    std::vector<std::string> metrics;
    std::string unit;
    std::function<std::vector<double>()> work;
    Spent spent = {};
    Turns turns = {};
  };
  bool do_round();  // whether anything was left to do

  double long_time_;
  int few_;
  std::function<double()> loop_;
  std::vector<Step> steps_;
};

}  // namespace terrabench::cross
