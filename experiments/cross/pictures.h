// Pictures of frames of the level-of-detail methods, all in the same colours and light.
#pragma once

#include "experiments/cross/flight.h"
#include "renderers/frame_renderer.h"

namespace terrabench::cross {

// Draws, and waits for the result. `wires`: width in pixels, 0 for none.
void draw_ground(FrameRenderer&, const Flight&, const Frame&, const View&, float wires = 0);

// Draws the full terrain in the flight's pictured frames, once per flight.
void draw_reference(Flight&, GlContext&, Progress&);

// The figure of one ground: every method's triangles in the same view halfway along the path, each method
// tuned to `pixels`.
void draw_wires(Flight&, double pixels, const std::string& options, GlContext&, Recorder&, Progress&);

}  // namespace terrabench::cross
