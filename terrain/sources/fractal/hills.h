// The hill technique (Alonso et al., §2.3.3, figure 10): hills are paraboloids of height r² − d² at distance
// d from their centre, cut off at zero, and add up where they overlap.
//
// O(area of all hills). Every sample adds its hills in the order of their numbers, so that the sums have the
// same bits on any number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench::fractal {

struct HillOptions {
  std::uint64_t seed = 1;
  int width = 513, depth = 513;                  // samples
  float cell = 30;                               // metres between samples
  int hills = 400;                               // 0 to 10,000,000
  float least_radius = 300, most_radius = 3000;  // metres
  float scale = 1;  // factor of r² − d²; 1, as printed, makes a hill of 100 m radius 10 km high
};

struct Hill {
  float x, z, radius;  // metres
};

// Each hill is a function of its number, the seed and the field's extent; radii are distributed uniformly.
// Centres lie on the field or within their radius of it, so that every place is equally likely to be under a
// hill. With fewer hills the terrain is an earlier stage of the same one. Both throw usage_error, and
// environment_error when the field does not fit the memory.
std::vector<Hill> draw_hills(const HillOptions&);
Heightfield hill_terrain(const HillOptions&);

// The same with the given hills, whose centres and radii are finite; a hill of radius 0 adds nothing. The
// options `seed`, `hills` and the radii are not used.
Heightfield raise_hills(const HillOptions&, const std::vector<Hill>& hills);

}  // namespace terrabench::fractal
