// An X server without a screen, for the tests of windows.
#pragma once

#include "terrain/image.h"

namespace terrabench {

// Starts Xvfb and sets DISPLAY to it, once per process; it ends with the process. Fails the test and returns
// false if it cannot be started.
bool start_virtual_display();

// The pixel of the screen, counted from its top left corner, where the first window is placed.
Rgb pixel_on_display(int x, int y);

}  // namespace terrabench
