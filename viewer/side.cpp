#include "viewer/side.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace terrabench::viewer {
namespace {

template <class Work>
double milliseconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Built build(const Method& method, std::shared_ptr<Ground> ground, double knob, Progress& progress) {
  Built built{method, std::move(ground), nullptr,
              std::isnan(knob) ? method.type->knob.fallback : setting(method.type->knob, knob)};
  built.lod = method.type->build(built.ground->lod(), method.options, progress);
  built.lod->tune(built.knob);
  return built;
}

Side::Side(GlContext& context, Built built) : context_(context), built_(std::move(built)) {
  triangles_.emplace(context);
}

void Side::show_landscape(bool landscape) {
  if (landscape ? landscape_.has_value() : triangles_.has_value()) return;
  if (landscape) {
    landscape_.emplace(context_, make_style(Parameters(landscape_parameters()), ground()->bounds));
    triangles_.reset();
  } else {
    triangles_.emplace(context_);
    landscape_.reset();
  }
  mapped_ = measured_ = false;  // the painted map went with the triangles
}

void Side::tune(double knob) {
  built_.knob = setting(built_.method.type->knob, knob);
  built_.lod->tune(built_.knob);
  mapped_ = false;
}

void Side::choose(const View& view) {
  now_.choose = milliseconds([&] { frame_ = &built_.lod->update(landscape_ ? surroundings(view) : view); });
  if (triangles_) {
    const std::size_t before = triangles_->bytes_uploaded();
    now_.send = milliseconds([&] { triangles_->upload(*frame_); });
    now_.bytes_sent = triangles_->bytes_uploaded() - before;
  }
  now_.triangles = frame_->stats.triangles;
  resting_ = view.eye == chosen_for_.eye && view.target == chosen_for_.target &&
             view.width == chosen_for_.width && view.height == chosen_for_.height;
  mapped_ = mapped_ && resting_ && frame_->uploads.empty() && frame_->stats.changes == 0;
  chosen_for_ = view;
}

void Side::draw(const View& view, const FrameStyle& style, double seconds) {
  now_.draw = milliseconds([&] {
    if (landscape_) {
      draw_landscape(view, seconds);
    } else {
      triangles_->draw_uploaded(view, style);
      triangles_->finish();
    }
  });
  now_.at = seconds;
  // Counting waits for work in the background, which would be felt in motion.
  if (resting_ && seconds > counted_at_ + 1) {
    counted_at_ = seconds;
    memory_ = built_.lod->memory().total();
  }
  now_.memory = memory_;
  history_.add(now_);
  now_.choose = now_.send = 0;
  now_.bytes_sent = 0;
}

// As `render --scene` does.
void Side::draw_landscape(const View& view, double seconds) {
  LandscapeStyle style = make_style(Parameters(landscape_parameters()), ground()->bounds);
  thin_fog(style, view.eye);
  landscape_->restyle(style);
  landscape_->draw(*frame_, view, seconds);
  landscape_->shows_ground();  // waits for the GPU
}

Image Side::draw_apart(const View& view, const FrameStyle& style) {
  if (landscape_) {
    draw_landscape(view, 0);
    return landscape_->image();
  }
  triangles_->draw_uploaded(view, style);
  return triangles_->image();
}

void Side::map_errors(double full) {
  const Heightfield& ground = built_.ground->heights;
  if (const auto map = mapper_.take()) {
    triangles_->paint(map->colours, {ground.extent_x(), ground.extent_z()});
    error_ = map->visible;
    measured_ = true;
  }
  if (mapper_.busy() || (mapped_ && mapped_full_ == full)) return;
  mapper_.start(*frame_, ground, chosen_for_, full);
  mapped_ = true;
  mapped_full_ = full;
}

FrameSample Side::take_edit(const SampleRect& rect, const View& view) {
  const double told = milliseconds([&] { built_.lod->edited(rect); });
  choose(view);
  if (landscape_) now_.send = milliseconds([&] { landscape_->skip(*frame_); });
  now_.choose += told;
  return now_;
}

void Side::before_edit() {
  mapper_.wait();
  memory_ = built_.lod->memory().total();
}

}  // namespace terrabench::viewer
