// What the viewer shows and can do, without a window and its interface: one ground, one or two methods with
// one camera, and what is drawn of them. Everything that takes long is done by a Job; drawing goes on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/context.h"
#include "viewer/camera.h"
#include "viewer/job.h"
#include "viewer/recorder.h"
#include "viewer/side.h"

namespace terrabench::viewer {

// What colours the ground; the last is FrameStyle's paint with the map of errors.
enum class Colours : std::uint8_t { kHeight, kTriangleSize, kError };

struct Look {
  Colours colours = Colours::kHeight;
  bool wires = false;
  bool landscape = false;  // materials, water, sky and shadows in place of colours and wires
  double full_error = 4;   // pixels, of the last colour of errors
  float split = 0.5F;      // of the window's width to the first method, where there are two
};

class Session {
 public:
  // Shows columns [from, to) of the context's picture.
  using Show = std::function<void(int from, int to)>;

  // The context must outlive it.
  Session(GlContext&, OpenGround);
  ~Session();

  Camera camera;
  Recorder recorder;
  Look look;
  std::string message;  // the last thing to tell the user

  // Start work; what was shown before is shown until it is done. `side`: 0, or 1 for the second method. The
  // last takes the second method away.
  void open(const std::string& ground);
  void show_method(int side, const std::string& name);
  void close_second();
  // Searches for the settings at which 99 % of the visible samples of this picture err by at most so many
  // pixels (lod/meters/knob_search.h), for each method that has a setting, and then sets them.
  void equalise(double pixels);
  bool working() const { return job_.running(); }
  Job::State work() const { return job_.state(); }
  // To be called every frame: takes over work that is done. Throws what the first work threw; what later
  // work throws becomes the message.
  void finish_work();

  bool ready() const { return !sides_.empty(); }
  // Of 0 and 1, below sides(). ready() must hold for these.
  int sides() const { return static_cast<int>(sides_.size()); }
  Side& side(int k) { return *sides_[static_cast<std::size_t>(k)]; }
  const Ground& ground() const { return *sides_.front()->ground(); }
  void tune(int side, double knob) { sides_[static_cast<std::size_t>(side)]->tune(knob); }

  // The view of a picture of this size: of the path that plays, otherwise the camera's.
  View view(glm::ivec2 size) const;
  // Keeps choosing triangles for the present view, wherever the eye goes; false ends this.
  void freeze(bool);
  const std::optional<View>& frozen() const { return frozen_; }

  // Draws all sides into the context's picture, one after another, and shows the part of each. `seconds`
  // since the start.
  void draw(glm::ivec2 size, double seconds, const Show&);
  // The picture at another size, wires and lines `scale` times as wide; both sides, divided as in the window.
  Image picture(glm::ivec2 size, float scale = 1);
  // The command that draws this picture without a window; empty where Ground::render is, and for two methods,
  // wires, other colours, a landscape with grass, frozen triangles, edits or a path that plays.
  std::string command(glm::ivec2 size) const;

  // Digs or fills a sphere and says what it cost. Refused with a message while work goes on and where a
  // surface with overhangs is shown.
  void edit(const Stroke&);
  void undo();

  void play(const CameraPath&);
  void stop();  // the camera stands where the path was
  bool playing() const { return !played_.empty(); }
  void advance(double seconds);  // of the path that plays; at its end the camera stands there

 private:
  struct Wanted {
    std::string ground = {};
    int opened = 0;  // how often a ground was asked for: the same file may have changed
    std::vector<std::string> methods = {};  // one or two
  };
  void build();
  std::shared_ptr<Ground> shown_ground(const Method&) const;
  void adopt(std::vector<Built>, const Wanted&);
  FrameStyle style(float scale) const;
  glm::ivec2 columns(int side, int width) const;
  void changed(const SampleRect&, const std::string& what);
  bool may_edit();

  GlContext& context_;
  OpenGround open_;
  Wanted wanted_{.methods = {"roam"}}, shown_;
  std::vector<std::unique_ptr<Side>> sides_;
  glm::ivec2 size_{800, 600};  // of the last picture drawn
  std::optional<View> frozen_;
  Edits edits_;
  std::vector<View> played_;
  double played_for_ = 0, frames_per_second_ = 25;
  Job job_;
};

}  // namespace terrabench::viewer
