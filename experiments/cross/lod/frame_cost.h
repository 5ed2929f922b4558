// What whole frames of one method cost along a flight: choosing the triangles (Lod::update), sending what
// changed to the GPU, and drawing.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "experiments/cross/lod/flight.h"
#include "renderers/frame_renderer.h"
#include "renderers/frame_timer.h"

namespace terrabench::cross {

// Seconds per frame. Choosing, sending and drawing are timed one by one, each until the GPU has finished;
// `whole` is the wall clock from the update to the end of drawing of the same frame in another pass, in which
// nothing waits in between. On a GPU, drawing is timed by the GPU's own clock (renderers/frame_timer.h).
struct FrameCost {
  double choose = 0, send = 0, draw = 0, whole = 0;
  double parts() const { return choose + send + draw; }
};

class MethodFrames {
 public:
  // Uploads the first frame whole, and afterwards the dirty ranges of each update. These are relative to the
  // update before, so nothing else may call update() on this method. The flight and the context must outlive
  // it. Throws environment_error if the renderer has no room for the ground.
  MethodFrames(const Flight&, std::unique_ptr<Lod>, GlContext&);

  // Means over these frames, indices of Flight::views. A few frames that are not timed lead up to each, so
  // that methods that keep a mesh between frames are in their usual state.
  FrameCost fly(const std::vector<std::size_t>& frames);
  // Per frame of the last fly(): triangles drawn, and bytes that the renderer sent to the GPU.
  double triangles() const { return triangles_; }
  double bytes_sent() const { return bytes_sent_; }

 private:
  void lead_up_to(std::size_t frame);

  const Flight& flight_;
  std::unique_ptr<Lod> lod_;
  FrameClock clock_;
  FrameRenderer renderer_;
  FrameStyle style_;
  double triangles_ = 0, bytes_sent_ = 0;
};

// From which size on one cost stays below another, by their ratio at each size.
struct Crossing {
  bool everywhere = false;  // below from the smallest size on
  bool nowhere = false;     // not below at the largest size
  double from = 0;          // samples; interpolated between two sizes, in logarithms; 0 for the cases above
};
// `samples` ascending, with a ratio for each; neither is empty.
Crossing crossing(const std::vector<double>& samples, const std::vector<double>& ratios);

}  // namespace terrabench::cross
