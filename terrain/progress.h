// Progress with an estimate of the time left, and cancellation by Ctrl-C. Long work takes a Progress& or
// Progress*.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace terrabench {

// Thread-safe except begin(). Costs an atomic add per step: a step should be a row or a slab, not a sample.
class Progress {
 public:
  enum class Output { kSilent, kLines, kTerminal };
  explicit Progress(Output output = Output::kSilent) : output_(output) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Begins a phase of so many equal steps; ends the phase before.
  void begin(std::string_view what, std::uint64_t steps);
  // Counts steps done. Throws Error(kInterrupted) once interrupt() was called: inside tbb::parallel_for that
  // cancels the loop and reaches its caller.
  void advance(std::uint64_t steps = 1);
  void end();

  // Asks all work in the process to stop at its next advance(). Safe in a signal handler.
  static void interrupt() { interrupted_.store(true, std::memory_order_relaxed); }
  static bool interrupted() { return interrupted_.load(std::memory_order_relaxed); }
  static void clear_interrupt() { interrupted_.store(false, std::memory_order_relaxed); }

 private:
  void show(std::uint64_t done);

  static std::atomic<bool> interrupted_;
  Output output_;
  std::string what_;
  std::uint64_t steps_ = 0;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::int64_t> next_show_{0};  // milliseconds since begin()
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace terrabench
