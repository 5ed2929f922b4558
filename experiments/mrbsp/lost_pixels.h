// Pixels that change when triangles are left out of a picture, judged by the triangle that each pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderers/frame_renderer.h"
#include "terrain/frame.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

// Identifies a triangle in all frames over one grid: no two triangles of a surface have the same directed
// edge.
std::uint64_t triangle_key(const Frame&, std::uint32_t triangle);

struct LostPixels {
  std::size_t ground = 0;  // show a triangle in the complete frame
  std::size_t lost = 0;    // of these: show another triangle, or none
  std::size_t open = 0;    // of these: show none
};
// Compares two frames of one view. Each renderer draws the frames of one method. O(pixels).
LostPixels lost_pixels(const Frame& all, FrameRenderer& of_all, const Frame& some, FrameRenderer& of_some,
                       const View&);

}  // namespace terrabench::mrbsp
