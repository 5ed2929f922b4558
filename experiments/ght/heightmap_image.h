// A heightmap as "ght" shows it: one grey pixel a sample.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::ght {

// Black is the lowest sample, white the highest; level ground is grey.
Image heightmap_image(const Heightfield&);

}  // namespace terrabench::ght
