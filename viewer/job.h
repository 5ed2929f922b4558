// Work in a thread of its own, one piece at a time, so that the window goes on drawing: opening ground,
// building a method, searching for a setting.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "terrain/progress.h"

namespace terrabench::viewer {

// Not thread-safe: the functions below are called by one thread, that of the window.
class Job {
 public:
  // Takes over what was done. Called by finish(), on its caller's thread.
  using TakeOver = std::function<void()>;
  using Work = std::function<TakeOver(Progress&)>;

  Job() = default;
  ~Job() { cancel(); }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  // Cancels the work before. `what` is shown until the work names a phase of its own.
  void start(std::string what, Work);
  bool running() const { return thread_.joinable(); }
  // If the work has ended, takes over its result, or throws what it threw. Returns whether it ended.
  bool finish();
  // Stops the work at its next step, waits for that and drops the result. Progress::interrupt() stops all
  // work in the process, so no other may be running.
  void cancel();

  struct State {
    std::string what;
    double share = 0;    // done, 0 to 1; 0 too where it is not known
    double seconds = 0;  // since the start
  };
  State state() const;

 private:
  void run(const Work&);

  std::thread thread_;
  std::atomic<bool> ended_{false};
  std::exception_ptr failure_;
  TakeOver take_over_;
  std::chrono::steady_clock::time_point begin_;
  mutable std::mutex mutex_;  // of what_ and share_
  std::string what_;
  double share_ = 0;
};

}  // namespace terrabench::viewer
