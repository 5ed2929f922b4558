// What a picture lacks when triangles are left out of it, by the triangle that each pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderers/frame_renderer.h"
#include "terrain/frame.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

// The same for the same triangle in every frame over one grid, and for no other: in a surface no two
// triangles run the same edge the same way.
std::uint64_t triangle_key(const Frame&, std::uint32_t triangle);

struct LostPixels {
  std::size_t ground = 0;  // show any triangle before
  std::size_t lost = 0;    // show another triangle, or none
  std::size_t open = 0;    // of these: none, where there was ground
};
// Of two frames of one view. Each renderer draws the frames of one method. O(pixels).
LostPixels lost_pixels(const Frame& all, FrameRenderer& of_all, const Frame& some, FrameRenderer& of_some,
                       const View&);

}  // namespace terrabench::mrbsp
