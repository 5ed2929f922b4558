#include "terrain/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <tuple>
#include <utility>

#include "terrain/duration.h"
#include "terrain/error.h"
#include "terrain/progress_listener.h"

namespace terrabench {
namespace {

constexpr std::int64_t kTerminalInterval = 100, kLineInterval = 5000;  // milliseconds between two lines

ProgressListener listener;

}  // namespace

void listen_to_progress(ProgressListener to) { listener = std::move(to); }

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60);
}

std::atomic<bool> Progress::interrupted_{false};

Progress::~Progress() { end(); }

void Progress::begin(std::string_view what, std::uint64_t steps) {
  end();
  what_ = what;
  steps_ = steps;
  done_ = 0;
  begin_ = std::chrono::steady_clock::now();
  // Short work shows nothing.
  next_show_ = output_ == Output::kTerminal ? kTerminalInterval : kLineInterval;
}

void Progress::advance(std::uint64_t steps) {
  // Release here, acquire in end(): the thread that ends a phase sees the writes of its steps, even through a
  // scheduler whose synchronisation a race detector cannot follow.
  const std::uint64_t done = done_.fetch_add(steps, std::memory_order_release) + steps;
  if (interrupted()) throw Error(ExitCode::kInterrupted, "interrupted", what_, "");
  if (output_ != Output::kSilent) show(done);
}

void Progress::show(std::uint64_t done) {
  using namespace std::chrono;
  const std::int64_t elapsed = duration_cast<milliseconds>(steady_clock::now() - begin_).count();
  std::int64_t due = next_show_.load(std::memory_order_relaxed);
  const std::int64_t interval = output_ == Output::kTerminal ? kTerminalInterval : kLineInterval;
  if (elapsed < due || !next_show_.compare_exchange_strong(due, elapsed + interval)) return;
  const double share =
      steps_ == 0 ? 0 : std::min(1.0, static_cast<double>(done) / static_cast<double>(steps_));
  if (output_ == Output::kTerminal && listener) {
    listener(what_, share);
    return;
  }
  const double left = share > 0 ? static_cast<double>(elapsed) / 1000 * (1 - share) / share : 0;
  const std::string line = fmt::format("{}: {:.0f} %, about {} left", what_, share * 100, duration(left));
  std::fprintf(stderr, output_ == Output::kTerminal ? "\r\033[K%s" : "%s\n", line.c_str());
  std::fflush(stderr);
}

void Progress::end() {
  std::ignore = done_.load(std::memory_order_acquire);
  if (output_ == Output::kTerminal && !listener && !what_.empty()) std::fputs("\r\033[K", stderr);
  what_.clear();
}

}  // namespace terrabench
