// Times of several pieces of work, taken in rounds: each piece once a round. A machine that others share is
// slow for some tenths of a second at a time; samples taken one after the other would all lie inside, or all
// outside, and their interval would not show it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/recorder.h"

namespace terrabench::cross {

class Rounds {
 public:
  // Of three samples in each of two runs, one run's all lie above the other's in one of ten unchanged times.
  // kFew is what long work can afford.
  static constexpr int kMost = 9, kFew = 3;

  // `long_time`: seconds.
  explicit Rounds(double long_time = 1) : long_time_(long_time) {}

  // Adds metrics of one unit. `work` is called once a round and returns a sample of each.
  void sample(std::vector<std::string> metrics, std::string unit, std::function<std::vector<double>()> work);
  void sample(std::string metric, std::string unit, std::function<double()> work);
  void time(std::string metric, std::function<void()> work);  // the seconds that it takes

  // Does all the work kMost times: less often what took the long time in all, but kFew times; and once what
  // took it alone. What the work refers to must still be there. Then forgets the work.
  void run(Recorder&);

 private:
  struct Step {
    std::vector<std::string> metrics;
    std::string unit;
    std::function<std::vector<double>()> work;
    double longest = 0, all = 0;  // seconds
  };
  double long_time_;
  std::vector<Step> steps_;
};

}  // namespace terrabench::cross
