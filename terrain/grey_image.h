// Pictures in shades of grey, 16 bits per pixel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "terrain/image.h"

namespace terrabench {

struct GreyImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> values;  // rows from top to bottom, 0 black to 65535 white
};
// Luma of BT.601, which gives a grey pixel its own value.
GreyImage grey(const Image&);

// Any PNG; transparent pixels become white. As in read_picture(), numbers are taken as they are stored: gamma
// and colour profiles, which say how bright a screen shows them, change nothing. Throws bad_input.
GreyImage read_grey_png(const std::filesystem::path&);

}  // namespace terrabench
