// Wall-clock and processor time of a piece of work.
#pragma once

#include <tbb/global_control.h>

#include <chrono>
#include <ctime>

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

// Seconds to make something, without those to destroy it.
template <class Make>
double seconds_to_make(const Make& make) {
  decltype(make()) made;
  return seconds([&] { made = make(); });
}

// Processor seconds of the calling thread and of the whole process.
inline double processor_time(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
inline double thread_seconds() { return processor_time(CLOCK_THREAD_CPUTIME_ID); }
inline double process_seconds() { return processor_time(CLOCK_PROCESS_CPUTIME_ID); }

// Processor seconds that a piece of work takes on one thread, to which TBB is limited. Other work of the
// machine is not counted.
template <class Work>
double processor_seconds(const Work& work) {
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  const double begin = thread_seconds();
  work();
  return thread_seconds() - begin;
}

}  // namespace terrabench
