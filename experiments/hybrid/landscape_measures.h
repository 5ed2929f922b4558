// What figures 20, 21, 24 and 25 of "hybrid" show, as numbers that an unrelated picture does not have.
#pragma once

#include "renderers/landscape/textures.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench::hybrid {

// Whether two channels of a map that wraps around are the slopes of one height, and its seam.
struct SlopeMap {
  // The mean difference of the mixed second derivatives, which are equal for slopes, as a share of their mean
  // size.
  double curl = 0;
  double seam_step = 0, largest_step = 0;  // between neighbouring texels: across the border, and inside
};
SlopeMap measure_slopes(const Texels&, int du, int dv);

// Largest differences between neighbouring columns, where the last meets the first and elsewhere.
struct Seam {
  double at_seam = 0, elsewhere = 0;
};
Seam measure_seam(const Texels&, int channel = 0);

// How a picture of still water is mixed from those of its reflection and its refraction. Pixels where these
// two are equal show no water.
struct WaterMix {
  double between = 0;        // share of the water's pixels whose colours lie between the two
  double near = 0, far = 0;  // share of the reflection, in the lower and the upper half of the water's rows
  double near_schlick = 0, far_schlick = 0;  // and by Schlick's approximation from the view
};
WaterMix measure_mix(const Image& reflection, const Image& refraction, const Image& mixed, const View&);

// Of pixels of water, or of the others, the share that differs between two pictures of one view.
double share_changed(const Image& a, const Image& b, const Image& reflection, const Image& refraction,
                     bool water);

// The correlation of the red of the upper half of a picture, which shows sky alone, with the noise map turned
// by `turns` of the dome: clouds are white, and the sky is blue.
double cloud_match(const Image&, const View&, const Texels& noise, double turns);

}  // namespace terrabench::hybrid
