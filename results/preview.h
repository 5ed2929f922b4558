// Small lossy copies of pictures, for pages that show many.
#pragma once

#include <string>

#include "terrain/image.h"

namespace terrabench {

// A WebP file at most `width` pixels wide. Equal pictures give equal bytes. Throws environment_error when the
// library fails, which it does for more than 16,383 rows. O(pixels).
std::string webp_preview(const Image&, int width);

}  // namespace terrabench
