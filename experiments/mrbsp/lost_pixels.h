// Pixels that change when triangles are left out of a picture, judged by the triangle that each pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderers/frame_renderer.h"
#include "terrain/frame.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

// Identifies a triangle in all frames over one grid: no two triangles of a surface have the same directed
// edge.
inline std::uint64_t triangle_key(const Frame& frame, std::uint32_t triangle) {
  const std::uint32_t* const at = frame.indices.data() + std::size_t{3} * triangle;
  return std::uint64_t{at[0]} << 32 | at[1];
}

struct LostPixels {
  std::size_t ground = 0;  // show a triangle in the complete frame
  std::size_t lost = 0;    // of these: show another triangle, or none
  std::size_t open = 0;    // of these: show none
};
// Compares two frames of one view. Each renderer draws the frames of one method. O(pixels).
inline LostPixels lost_pixels(const Frame& all, FrameRenderer& of_all, const Frame& some,
                              FrameRenderer& of_some, const View& view) {
  const std::vector<std::uint32_t> before = of_all.triangle_numbers(all, view);
  const std::vector<std::uint32_t> after = of_some.triangle_numbers(some, view);
  LostPixels pixels;
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (before[k] == 0) continue;
    ++pixels.ground;
    pixels.open += after[k] == 0;
    pixels.lost += after[k] == 0 || triangle_key(all, before[k] - 1) != triangle_key(some, after[k] - 1);
  }
  return pixels;
}

}  // namespace terrabench::mrbsp
