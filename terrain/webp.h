// Pictures as WebP, through libwebp.
#pragma once

#include <string_view>

#include "terrain/image.h"

namespace terrabench {

bool is_webp(std::string_view bytes);

// Without losses, or with them if that saves a third of the bytes: drawings keep their sharp lines and exact
// colours, and renderings become small. Equal pictures give equal bytes. Throws environment_error for
// more than 16,383 pixels a side.
std::vector<std::byte> webp_of(const Image&);
// As picture_size() and read_picture() of a file with these bytes. Animations are refused.
std::array<int, 2> webp_size(std::string_view bytes, std::string_view origin);
Image decode_webp(std::string_view bytes, std::string_view origin);

}  // namespace terrabench
