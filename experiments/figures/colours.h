// Colours and shading of figures. Readers with the common kinds of colour blindness can tell the colours
// apart: a scale whose hue has a meaning runs from blue to orange or red, and its lightness varies as well.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::figures {

// Marks on maps coloured by elevation: channel pixels, and samples that no drill reaches.
inline constexpr Rgb kChannel{0, 56, 168}, kUntouched{120, 120, 128};

// Cream at t = 0, the lowest height, to brown at 1, the highest; light enough for lines and shading on top.
Rgb elevation_colour(double t);
// Blue at t = 0 (too low), white at ½ (equal), red at 1 (too high). ColorBrewer's RdBu.
Rgb difference_colour(double t);
// Blue for 0, red for 1, as in figure 4 of "drill". ColorBrewer's RdYlBu.
Rgb error_colour(double t);
// Cyclic colour of a direction in turns: 0 and 1 have the same. Dark enough for thin lines on white.
Rgb direction_colour(double turn);

// Lambert shading of each sample of a height field, 0 to 1, with the sun in the north-west, 45° high. Slopes
// are scaled by one factor per field, so that steep and gentle ground have similar contrast.
class Light {
 public:
  // Keeps a reference to the field. O(samples)
  explicit Light(const Heightfield& field);
  // Scales slopes by the factor of `as`, so that the two fields can be compared.
  Light(const Heightfield& field, const Light& as) : field_(field), exaggeration_(as.exaggeration_) {}
  double at(int i, int j) const;

 private:
  struct Slope {
    double east, south;
  };
  Slope slope(int i, int j) const;

  const Heightfield& field_;
  double exaggeration_ = 1;
};
// The colour multiplied by 0.45 + 0.75 · light, at most 1.
Rgb lit(const Rgb& colour, double light);

// Black or white, whichever can be read on this colour.
Rgb ink_on(const Rgb& colour);

}  // namespace terrabench::figures
