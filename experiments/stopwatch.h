// Wall-clock time of a piece of work.
#pragma once

#include <chrono>

namespace terrabench {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

template <class Work>
double seconds(const Work& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
}

}  // namespace terrabench
