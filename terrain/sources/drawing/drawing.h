// Land from a picture (MRBSP paper, §1): the designer draws it in any art program, x and y are kept, and
// intensity becomes height, black under the sea and white a peak.
//
// The paper names four adjustments without formulas. Here: an intensity g in [0, 1] of at least the sea level
// s is land, at (g - s)/(1 - s) of the peak's height; below s it is sea, down to the bed at black. So a
// higher s sinks the land while white stays the highest peak, and a shallower bed makes the shore gentler and
// with it, once smoothed, the beaches wider. Smoothing is diffusion: each pass moves a sample towards the
// binomial mean of the 3×3 around it: fully on hills, less above three quarters of the height at which
// mountains begin, and not at all above that height. O(pixels · passes), in parallel.
#pragma once

#include <string>
#include <string_view>

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench {

struct DrawingOptions {
  float cell = 30;         // metres per pixel
  float sea_level = 0.3F;  // intensity at the shore, in [0, 1)
  float peak = 1000;       // metres, height of white above the sea
  float seabed = 0.1F;     // depth of black below the sea, as a share of the peak; 0 to 1
  int smoothing = 2;       // passes, 0 to 1000
  float mountains = 0.6F;  // height from which ground is never smoothed, as a share of the peak; 0 to 1
};

// One sample per pixel, the sea's surface at 0. Throws usage_error for an empty picture or options out of
// range, and environment_error where memory would not suffice.
Heightfield land_from_drawing(const GreyImage&, const DrawingOptions&);
inline Heightfield land_from_drawing(const Image& picture, const DrawingOptions& options) {
  return land_from_drawing(grey(picture), options);
}

// A drawing by name: FILE[,ADJUSTMENT=VALUE…], such as "coast.png,sea_level=0.4,peak=1500".
struct NamedDrawing {
  std::string file;
  DrawingOptions options;
};
// Throws usage_error for an unknown adjustment or one that is not a number.
NamedDrawing parse_drawing(std::string_view);

// A drawing as the paper describes: grey clouds for hills (seeded), a winding river and a lake masked in
// black, and ridges as lightened lines. O(pixels · octaves).
Image example_drawing(int side, std::uint64_t seed);

}  // namespace terrabench
