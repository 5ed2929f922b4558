#include "viewer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lod/camera/camera_path.h"
#include "terrain/error.h"
#include "terrain/framing.h"
#include "viewer/equal_error.h"

namespace terrabench::viewer {
namespace {

constexpr double kUsual = std::numeric_limits<double>::quiet_NaN();

// A solid is opened with a near surface for methods that draw one, and without for the others.
bool fits(const Ground& ground, const Method& method) {
  return !ground.solid || method.type->traits.near_surface == (ground.surface != nullptr);
}

}  // namespace

Session::Session(GlContext& context, OpenGround open) : context_(context), open_(std::move(open)) {}

Session::~Session() { job_.cancel(); }

void Session::open(const std::string& ground) {
  wanted_.ground = ground;
  ++wanted_.opened;
  build();
}

void Session::show_method(int side, const std::string& name) {
  method_named(name);  // throws here, not in the thread
  wanted_.methods.resize(std::max(wanted_.methods.size(), static_cast<std::size_t>(side) + 1), name);
  wanted_.methods[static_cast<std::size_t>(side)] = name;
  build();
}

void Session::close_second() {
  wanted_.methods.resize(1);
  build();
}

// Of the ground that is shown, if it is the wanted one and fits the method.
std::shared_ptr<Ground> Session::shown_ground(const Method& method) const {
  if (shown_.opened != wanted_.opened) return nullptr;
  for (const auto& side : sides_) {
    if (fits(*side->ground(), method)) return side->ground();
  }
  return nullptr;
}

// Builds every wanted side that is not shown already.
void Session::build() {
  if (wanted_.ground.empty()) return;
  std::vector<Built> plan;  // without a method to keep the side's, without ground to open it
  std::vector<bool> kept;
  for (std::size_t k = 0; k < wanted_.methods.size(); ++k) {
    plan.push_back({method_named(wanted_.methods[k]), nullptr, nullptr, kUsual});
    plan.back().ground = shown_ground(plan.back().method);
    kept.push_back(k < sides_.size() && plan.back().ground == sides_[k]->ground() &&
                   sides_[k]->method().name == wanted_.methods[k]);
  }
  auto built = std::make_shared<std::vector<Built>>(std::move(plan));
  job_.start(fmt::format("opening {}", wanted_.ground),
             [this, built, kept, wanted = wanted_](Progress& progress) -> Job::TakeOver {
               for (std::size_t k = 0; k < built->size(); ++k) {
                 Built& one = (*built)[k];
                 if (kept[k]) continue;
                 const bool shared = k > 0 && fits(*built->front().ground, one.method);
                 if (!one.ground && shared) one.ground = built->front().ground;
                 if (!one.ground)
                   one.ground = open_(wanted.ground, one.method.type->traits.near_surface, progress);
                 one = viewer::build(one.method, one.ground, kUsual, progress);
               }
               return [this, built, wanted] { adopt(std::move(*built), wanted); };
             });
}

void Session::adopt(std::vector<Built> built, const Wanted& wanted) {
  const bool moved = shown_.opened != wanted.opened;
  const std::shared_ptr<Ground> before = ready() ? sides_.front()->ground() : nullptr;
  std::vector<std::unique_ptr<Side>> sides;
  for (std::size_t k = 0; k < built.size(); ++k) {
    sides.push_back(built[k].lod ? std::make_unique<Side>(context_, std::move(built[k]))
                                 : std::move(sides_[k]));
  }
  sides_ = std::move(sides);
  shown_ = wanted;
  if (sides_.front()->ground() != before) edits_.clear();
  if (!moved) {
    camera.keep_on(ground().heights, ground().bounds);
    return;
  }
  frozen_.reset();
  played_.clear();
  recorder = Recorder();
  camera.stand_on(ground().heights, ground().bounds);
  message = fmt::format("{}: {} × {} samples", ground().name, ground().heights.width, ground().heights.depth);
  for (const std::string& note : ground().notes) message += "; " + note;
}

void Session::equalise(double pixels) {
  if (!ready() || working()) return;
  std::vector<EqualError> searches;
  for (const auto& side : sides_) searches.push_back({side->method(), side->ground(), 0, 0, false});
  const View seen = frozen_.value_or(view(size_));
  job_.start("searching", [this, searches, seen, pixels](Progress& progress) mutable -> Job::TakeOver {
    for (EqualError& one : searches) search(one, seen, pixels, progress);
    return [this, searches, pixels] {
      std::vector<std::string> found;
      for (std::size_t k = 0; k < searches.size() && k < sides_.size(); ++k) {
        sides_[k]->tune(searches[k].knob);
        found.push_back(describe(searches[k]));
      }
      message = fmt::format("99 % within {} px here: {}", pixels, fmt::join(found, "; "));
    };
  });
}

void Session::finish_work() {
  try {
    job_.finish();
  } catch (const Error& error) {
    if (!ready()) throw;
    wanted_ = shown_;
    message = fmt::format("{} ({})", error.what(), error.advice());
  } catch (const std::exception& error) {  // such as memory that ran out
    if (!ready()) throw;
    wanted_ = shown_;
    message = error.what();
  }
}

View Session::view(glm::ivec2 size) const {
  View view = camera.view(size.x, size.y);
  if (!played_.empty()) {
    const auto frame = static_cast<std::size_t>(played_for_ * frames_per_second_);
    view = played_[std::min(frame, played_.size() - 1)];
    view.width = size.x;
    view.height = size.y;
  }
  set_depth_planes(view, ground().heights, ground().bounds, !look.landscape);
  return view;
}

void Session::freeze(bool frozen) {
  frozen_.reset();
  if (frozen) frozen_ = view(size_);
}

void Session::play(const CameraPath& path) {
  played_ = views(path, ground().heights);
  played_for_ = 0;
  frames_per_second_ = path.frames_per_second;
}

void Session::stop() {
  if (!played_.empty()) camera.take(view(size_));
  played_.clear();
}

void Session::advance(double seconds) {
  if (played_.empty()) return;
  played_for_ += seconds;
  if (played_for_ * frames_per_second_ >= static_cast<double>(played_.size())) stop();
}

}  // namespace terrabench::viewer
