// One method on one ground, with what draws it: the same calls, in the same order, as the experiments and
// `render` make.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "renderers/frame_renderer.h"
#include "renderers/landscape/landscape.h"
#include "viewer/edits.h"
#include "viewer/error_map.h"
#include "viewer/ground.h"
#include "viewer/history.h"
#include "viewer/method.h"

namespace terrabench::viewer {

// A method as it was built, in any thread.
struct Built {
  Method method;
  std::shared_ptr<Ground> ground;
  std::unique_ptr<Lod> lod;
  double knob = 0;
};
// `knob`: the method's usual setting if NaN. Throws as LodType::build.
Built build(const Method&, std::shared_ptr<Ground>, double knob, Progress&);

class Side {
 public:
  // The context must outlive it.
  Side(GlContext&, Built);

  const Method& method() const { return built_.method; }
  const std::shared_ptr<Ground>& ground() const { return built_.ground; }
  double knob() const { return built_.knob; }
  void tune(double knob);  // as Lod::tune()

  // From the next choose() on, draws a landscape, or triangles again. Takes a second where it changes.
  void show_landscape(bool);
  // Chooses the triangles for the view and sends what changed; a landscape is sent with its picture.
  void choose(const View&);
  // Draws the triangles chosen last, once, as seen from any view. `seconds` since the start, for the history
  // and for clouds and waves. A landscape has no FrameStyle.
  void draw(const View&, const FrameStyle&, double seconds);
  // The same as a picture, not counted in the history.
  Image draw_apart(const View&, const FrameStyle&);

  // Takes over a finished error map. If none is being computed and the triangles or `full` changed, starts
  // one of the triangles chosen last, for their view.
  void map_errors(double full);
  const Deviation* error() const { return measured_ ? &error_ : nullptr; }  // of the last map; null without

  // Before the ground changes: waits for work that reads it.
  void before_edit();
  // After it has changed there: chooses for the view, and returns what that and sending it cost.
  FrameSample take_edit(const SampleRect&, const View&);

  const History& history() const { return history_; }

 private:
  void draw_landscape(const View&, double seconds);

  GlContext& context_;
  Built built_;
  // One of both: each takes over every frame.
  std::optional<FrameRenderer> triangles_;
  std::optional<LandscapeRenderer> landscape_;
  History history_;
  FrameSample now_{};
  View chosen_for_;
  const Frame* frame_ = nullptr;
  ErrorMapper mapper_;
  Deviation error_{};
  bool measured_ = false, resting_ = false;
  bool mapped_ = false;  // the triangles chosen last, at mapped_full_
  double mapped_full_ = 0;
  double counted_at_ = -1e9;  // seconds
  std::size_t memory_ = 0;
};

}  // namespace terrabench::viewer
