// How long a run will still take.
#pragma once

#include <fmt/format.h>

#include <string>

#include "experiments/stopwatch.h"
#include "terrain/duration.h"

namespace terrabench {

// Estimates the time left from that of the cases so far, in proportion to RunPlan::seconds.
class TimeLeft {
 public:
  void expect(double weight) { left_ += weight; }
  void done(double weight) {
    left_ -= weight;
    done_ += weight;
  }
  double expected() const { return left_; }
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
};

}  // namespace terrabench
