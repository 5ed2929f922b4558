// An off-screen context through EGL: on a GPU, without a display or window.
#pragma once

#include <cstdint>
#include <memory>

#include "renderers/context.h"

namespace terrabench {

enum class EglDevices : std::uint8_t {
  kAll,   // GPUs in the driver's order, then Mesa's software device, then Mesa without any device
  kGpus,  // GPUs only
};

// Opens the first device that can be initialised and has OpenGL 4.5. GlContext::renderer() names it. Throws
// environment_error when the library is absent or there is no such device.
std::unique_ptr<GlContext> open_egl(int width, int height, EglDevices devices = EglDevices::kAll,
                                    const char* library = "libEGL.so.1");

}  // namespace terrabench
