// The procedural textures of a landscape, from the noise graph (terrain/sources/noise): materials, the
// water's du/dv and normal map, and the sky's noise map. All wrap around without a seam, and the same seed
// gives the same texels on every machine. Computed on all cores; a graph of six octaves takes about 0.1 µs
// per texel.
#pragma once

#include <cstdint>
#include <vector>

namespace terrabench {

// `channels` floats per texel, rows from v = 0.
struct Texels {
  int width = 0, height = 0, channels = 1;
  std::vector<float> values;

  float at(int x, int y, int channel = 0) const {
    return values[(static_cast<std::size_t>(y) * width + x) * channels + channel];
  }
};

// The sky's noise map (hybrid paper, §4.3 and figure 24): u is the azimuth as a share of a turn, clockwise
// from north; v runs from the zenith, 0, to the horizon, 1. A texel is the noise where its direction meets a
// flattened dome of clouds, so that the first and last column agree, all texels of the zenith are equal and
// nothing is stretched there. Equalised: values are evenly distributed over 0…1. `size` scales the clouds.
Texels sky_noise(int width, int height, std::uint64_t seed, float size);

// Waves as seamless noise of `side`² texels: du, dv, slope along x, slope along z. The first two warp the
// reflected and refracted pictures (hybrid paper, §3.4 and figure 20), in -1…1; the others are the normal
// map, the gradient of the waves' height where the texture is one metre wide and its steepest slope is 1.
Texels wave_map(int side, std::uint64_t seed);

// A material, numbered as in LandscapeStyle: tone 0…1; bump slopes along u and v, 0…1 with 0.5 level; and
// patches, wide variations of tone, 0…1.
Texels material_map(int material, int side, std::uint64_t seed);

}  // namespace terrabench
