// Mesa's off-screen context (OSMesa): software rendering with llvmpipe, no display, GPU or X needed.
#pragma once

#include <memory>

#include "renderers/context.h"

namespace terrabench {

// Throws environment_error when the library is absent, or its Mesa has no OpenGL 4.5.
std::unique_ptr<GlContext> open_osmesa(int width, int height, const char* library = "libOSMesa.so.8");

}  // namespace terrabench
