// Frame times. A GPU is timed by its own timer queries, which count drawing alone. On the processor
// (llvmpipe) these read about 0, so there the wall clock runs from the first draw call until all have
// finished. Nothing waits for a display: contexts draw off-screen.
#pragma once

#include <functional>
#include <vector>

#include "renderers/context.h"

namespace terrabench {

enum class FrameClock { kTimerQueries, kWall };

// The clock for the context, which must be current.
FrameClock frame_clock(const GlContext&);

// Draws `warm_up` frames that are not timed, then `frames` that are; returns the seconds of each of these.
// The function draws the frame of that number, counted from 0 with the warm-up; it must not wait for the GPU.
// The context must be current. Throws environment_error if OpenGL reported an error.
std::vector<double> time_frames(FrameClock, int warm_up, int frames, const std::function<void(int)>& draw);

}  // namespace terrabench
