// Small lossy copies of pictures, for pages that show many.
#pragma once

#include <string>

#include "terrain/image.h"

namespace terrabench {

// A WebP file at most `width` pixels wide and 16,383 high. Equal pictures give equal bytes. Throws
// environment_error when the library fails, for want of memory. O(pixels).
std::string webp_preview(const Image&, int width);

}  // namespace terrabench
