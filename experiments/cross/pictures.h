// Frames of the level-of-detail methods as pictures, all in the same colours and light.
#pragma once

#include "experiments/cross/flight.h"
#include "renderers/frame_renderer.h"

namespace terrabench::cross {

// Draws and waits until it is drawn. Wires of this many pixels, 0 for none.
void draw_ground(FrameRenderer&, const Flight&, const Frame&, const View&, float wires = 0);

// The full terrain in the flight's pictured frames, once a flight.
void draw_reference(Flight&, GlContext&, Progress&);

// The figure of one ground: every method's triangles in the same view, half-way along the path, each method
// tuned to `pixels`.
void draw_wires(Flight&, double pixels, const std::string& options, GlContext&, Recorder&, Progress&);

}  // namespace terrabench::cross
