// The procedural texture of grass billboards: tufts of tapering, leaning blades.
#pragma once

#include <cstdint>
#include <vector>

namespace terrabench {

inline constexpr int kGrassLayers = 4;
inline constexpr int kGrassTexels = 256;  // side of the largest level, a power of two

// One level of the layers: sRGB and opacity of each texel, rows from the roots upwards.
struct GrassTexels {
  int side = 0;
  std::vector<std::uint8_t> rgba;  // kGrassLayers · side² · 4 bytes
};

// From kGrassTexels down to one texel. Smaller levels keep the share of texels that are more than half
// opaque, so that grass does not get thinner with distance. The same bytes each time. Takes milliseconds.
std::vector<GrassTexels> paint_grass();

}  // namespace terrabench
