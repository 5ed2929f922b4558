#include "viewer/view.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <optional>

#include "terrain/files.h"
#include "terrain/machine_error.h"
#include "viewer/input.h"
#include "viewer/interface.h"
#include "viewer/panels.h"
#include "viewer/script.h"

namespace terrabench::viewer {
namespace {

using Clock = std::chrono::steady_clock;

// Longest waits for events, seconds: when nothing moves, and while the first ground is opened.
constexpr double kRest = 0.1, kLoading = 0.03;

std::unique_ptr<Window> open(glm::ivec2 size) {
  try {
    return open_window(size, "terrabench");
  } catch (const Error& error) {
    throw MachineError(
        error.what(), "view",
        "`terrabench render GROUND --lod NAME` draws the same pictures without a display, with "
        "--path a flight, and `terrabench run cross.lod-equal-error` measures the same methods; "
        "or " +
            error.advice());
  }
}

// One window with everything in it.
class Viewer {
 public:
  Viewer(const ViewOptions& options, const OpenGround& open_ground)
      : window_(open(options.window)), session_(*window_, open_ground), interface_(*window_) {
    controls_.panels = options.panels;
    if (!options.script.empty()) script_.emplace(read_file(options.script), options.script.string());
    for (std::size_t k = 0; k < options.methods.size(); ++k)
      session_.show_method(static_cast<int>(k), options.methods[k]);
    session_.open(options.ground);
  }

  ExitCode run() {
    while (!window_->closing() && !controls_.quit && !(script_ && script_->ended())) {
      if (Progress::interrupted()) return ExitCode::kInterrupted;
      const auto begin = Clock::now();
      frame();
      seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
      if (script_ && session_.ready()) all_seconds_.push_back(seconds_);
    }
    if (script_) report();
    return ExitCode::kGood;
  }

 private:
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  bool rests() const {
    return !script_ && input_.idle() && !session_.working() && !session_.playing() &&
           session_.look.colours != Colours::kError && now() > busy_until_;
  }

  // Whether anything may look different from the frame before.
  bool take_events() {
    const bool rest = rests();
    std::vector<WindowEvent> events = window_->events(rest ? kRest : session_.ready() ? 0 : kLoading);
    if (rest && events.empty()) return false;
    if (!events.empty()) busy_until_ = now() + 1;
    if (script_) {
      const std::vector<WindowEvent> scripted = script_->step(*window_, session_, controls_);
      events.insert(events.end(), scripted.begin(), scripted.end());
    }
    for (const WindowEvent& event : events) take(event);
    return true;
  }

  void take(const WindowEvent& event) {
    interface_.take(event);
    const bool of_mouse =
        event.kind == WindowEvent::Kind::kButton || event.kind == WindowEvent::Kind::kScroll;
    const bool for_ground = of_mouse ? !interface_.takes_mouse() : !interface_.takes_keys();
    try {
      input_.take(event, for_ground, session_, controls_);
    } catch (const Error& error) {  // such as a folder that takes no picture
      if (script_) throw;
      session_.message = error.what();
    }
  }

  void frame() {
    if (!take_events()) return;
    session_.finish_work();
    if (session_.ready() && session_.ground().name != title_) {
      title_ = session_.ground().name;
      window_->set_title("terrabench: " + title_);
    }
    const double step = script_ ? Script::kStep : std::clamp(seconds_, 1e-4, 0.1);
    input_.move(session_, step);
    session_.advance(step);
    if (session_.ready()) session_.recorder.add(session_.camera, session_.ground().heights, time_ += step);
    const glm::ivec2 size = window_->size();
    if (size.x < 1 || size.y < 1) return;  // minimised
    controls_.window = size;
    draw(size);
  }

  void draw(glm::ivec2 size) {
    const bool ready = session_.ready();
    if (ready) {
      session_.draw(size, now(), [&](int from, int to) { window_->show(from, to); });
    } else {
      window_->clear({236, 238, 242});
    }
    interface_.begin(size, std::max(1e-4, seconds_));
    if (ready) show_marks(session_, controls_);
    if (ready && controls_.panels) show_panels(session_, controls_, seconds_);
    if (!ready || controls_.panels) show_work(session_, controls_);
    interface_.end();
    window_->swap();
  }

  void report() {
    if (all_seconds_.empty()) return;
    std::ranges::sort(all_seconds_);
    const double sum = std::accumulate(all_seconds_.begin(), all_seconds_.end(), 0.0);
    const auto count = static_cast<double>(all_seconds_.size());
    fmt::print("frames      {}, {:.1f} per second, median {:.1f} ms, slowest {:.1f} ms\n",
               all_seconds_.size(), count / sum, 1e3 * all_seconds_[all_seconds_.size() / 2],
               1e3 * all_seconds_.back());
  }

  std::unique_ptr<Window> window_;
  Session session_;
  Interface interface_;
  Controls controls_;
  Input input_;
  std::optional<Script> script_;
  std::string title_;
  Clock::time_point start_ = Clock::now();
  double seconds_ = Script::kStep, busy_until_ = 1, time_ = 0;  // seconds_: of the frame before
  std::vector<double> all_seconds_;
};

}  // namespace

ExitCode view(const ViewOptions& options, const OpenGround& open_ground) {
  return Viewer(options, open_ground).run();
}

}  // namespace terrabench::viewer
