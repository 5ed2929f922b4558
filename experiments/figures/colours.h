// Colours and light of figures. Readers with the common kinds of colour blindness can tell them apart: where
// hue has a meaning it runs between blue and orange or red, and lightness changes with it.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::figures {

// Marks on top of the colours of elevations.
inline constexpr Rgb kChannel{0, 56, 168}, kUntouched{120, 120, 128};

// From the lowest, 0, to the highest, 1: cream to brown, light enough for lines and shading on top.
Rgb elevation_colour(double t);
// 0 to ½, for what is too low: blue to white. ½ to 1, for what is too high: white to red. ColorBrewer's RdBu.
Rgb difference_colour(double t);
// Blue for 0, red for 1, as in figure 4 of "drill". ColorBrewer's RdYlBu.
Rgb error_colour(double t);
// For a direction, in turns: equal for whole turns; dark enough for thin lines on white.
Rgb direction_colour(double turn);

// How light each sample of a height field is, 0 to 1, with the sun in the north-west, 45° high. Slopes are
// scaled by one factor per field, so that steep and gentle ground have similar contrast.
class Light {
 public:
  // Keeps a reference to the field. O(samples)
  explicit Light(const Heightfield& field);
  // With the scale of another field's light, so that the two can be compared.
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
// A colour in that light, dimmed to 45 % at most.
Rgb lit(const Rgb& colour, double light);

// Black or white, whichever can be read on this colour.
Rgb ink_on(const Rgb& colour);

}  // namespace terrabench::figures
