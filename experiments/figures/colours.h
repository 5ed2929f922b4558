// The colours of the drill paper's figures. All are told apart by the common kinds of colour vision: where
// hue carries a meaning it runs between blue and orange or red, and lightness goes with it.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::figures {

// Over the colours of elevations.
inline constexpr Rgb kChannel{0, 56, 168}, kUntouched{120, 120, 128};

// From the lowest, 0, to the highest, 1: cream to brown, light enough for lines and shade upon it.
Rgb elevation_colour(double t);
// Below, 0 to ½: blue to white. Above, ½ to 1: white to red. ColorBrewer's RdBu.
Rgb difference_colour(double t);
// Blue for 0, red for 1, as in figure 4. ColorBrewer's RdYlBu.
Rgb error_colour(double t);
// Around the circle and back to the same colour; dark enough for thin lines on white.
Rgb direction_colour(double turn);

// How light each sample of a ground is, 0 … 1, with the sun in the north-west, halfway up. Steep grounds are
// lit as if they were lower and gentle ones as if they were higher, so that all look alike and none goes
// black.
class Light {
 public:
  // Keeps the field by reference. O(samples)
  explicit Light(const Heightfield& field);
  // In the same light as another, of which it is a likeness.
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
// A colour in such light, never so dark that it cannot be told.
Rgb lit(const Rgb& colour, double light);

// Black or white, whichever can be read on this colour.
Rgb ink_on(const Rgb& colour);

}  // namespace terrabench::figures
