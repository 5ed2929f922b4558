// A height field as a grey image, one pixel per sample.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::figures {

// Black is the lowest sample, white the highest; all of a level field is the middle grey. O(samples)
Image heightmap_image(const Heightfield&);

}  // namespace terrabench::figures
