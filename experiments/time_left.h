// How long a run will still take.
#pragma once

#include <fmt/format.h>

#include <string>

#include "experiments/stopwatch.h"
#include "terrain/duration.h"

namespace terrabench {

// Time left: the expected time of the other cases, times elapsed ÷ expected time of the finished ones.
class TimeLeft {
 public:
  // Seconds of one case; 0: not known.
  void expect(double weight) {
    left_ += weight;
    ++(weight > 0 ? known_ : unknown_);
  }
  void done(double weight) {
    left_ -= weight;
    done_ += weight;
  }
  // A line such as "this takes about 5 min on two cores", before the first case; empty if nothing is known.
  std::string forecast() const {
    if (known_ == 0) return "";
    const std::string but = unknown_ == 0
                                ? ""
                                : fmt::format(", and the {} case{} that the reference run did not time",
                                              unknown_, unknown_ == 1 ? "" : "s");
    return fmt::format("this takes about {} on two cores{}\n", duration(left_), but);
  }
  // Such as ", about 2 min left", counting a case of that weight that just ended; empty in the first seconds
  // and when no case is left.
  std::string text(double weight) const {
    constexpr double kSoonest = 5;  // seconds
    const double seconds = watch_.seconds(), left = left_ - weight;
    if (seconds < kSoonest || left <= 0) return "";
    return fmt::format(", about {} left", duration(seconds * left / (done_ + weight)));
  }

 private:
  Stopwatch watch_;
  double left_ = 0, done_ = 0;
  int known_ = 0, unknown_ = 0;  // cases
};

}  // namespace terrabench
