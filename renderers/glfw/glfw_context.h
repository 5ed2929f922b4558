// A window through GLFW, on an X display. Pictures are drawn off-screen as in other contexts, and present()
// copies them into the window.
#pragma once

#include <memory>

#include "renderers/context.h"

namespace terrabench {

// A hidden window serves for pictures in memory. Only the main thread may open windows. Throws
// environment_error when the library is absent, there is no display, or it has no OpenGL 4.5.
std::unique_ptr<GlContext> open_glfw(int width, int height, bool visible = false,
                                     const char* library = "libglfw.so.3");

}  // namespace terrabench
