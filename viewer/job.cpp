#include "viewer/job.h"

#include <exception>
#include <utility>

#include "terrain/progress_listener.h"

namespace terrabench::viewer {

void Job::start(std::string what, Work work) {
  cancel();
  what_ = std::move(what);
  share_ = 0;
  ended_ = false;
  failure_ = nullptr;
  take_over_ = nullptr;
  begin_ = std::chrono::steady_clock::now();
  listen_to_progress([this](std::string_view phase, double share) {
    const std::lock_guard lock(mutex_);
    what_ = phase;
    share_ = share;
  });
  thread_ = std::thread([this, work = std::move(work)] { run(work); });
}

void Job::run(const Work& work) {
  try {
    Progress progress(Progress::Output::kTerminal);  // that is, the listener
    take_over_ = work(progress);
  } catch (...) {
    failure_ = std::current_exception();
  }
  ended_ = true;
}

bool Job::finish() {
  if (!running() || !ended_) return false;
  thread_.join();
  listen_to_progress(nullptr);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  const TakeOver take_over = std::exchange(take_over_, nullptr);
  if (take_over) take_over();
  return true;
}

void Job::cancel() {
  if (!running()) return;
  const bool before = Progress::interrupted();
  Progress::interrupt();
  thread_.join();
  if (!before) Progress::clear_interrupt();
  listen_to_progress(nullptr);
  failure_ = nullptr;
  take_over_ = nullptr;
}

Job::State Job::state() const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  const std::lock_guard lock(mutex_);
  return {what_, share_, elapsed.count()};
}

}  // namespace terrabench::viewer
