// Numbers read from pictures.
#pragma once

#include <cmath>
#include <cstdint>

#include "terrain/image.h"

namespace terrabench::hybrid {

// The light that a byte of a picture shows, 0 to 1; exact below the display's shoulder (display.glsl).
inline double light_of(std::uint8_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Red less blue, in the display's units: above 0 where a colour is warm.
inline double warmth(const Rgb& pixel) { return (pixel[0] - pixel[2]) / 255.0; }

// A part of a picture: columns from left to right and rows from top to bottom, as shares of its sides.
struct Part {
  double left = 0, right = 1, top = 0, bottom = 1;
};

// The mean over the part's pixels of what `measure` gives for each: measure(pixel).
template <class Measure>
double mean_over(const Image& image, const Part& part, const Measure& measure) {
  double sum = 0, count = 0;
  for (int y = static_cast<int>(part.top * image.height); y < static_cast<int>(part.bottom * image.height);
       ++y) {
    for (int x = static_cast<int>(part.left * image.width); x < static_cast<int>(part.right * image.width);
         ++x, ++count)
      sum += measure(image.pixel(x, y));
  }
  return sum / count;
}

}  // namespace terrabench::hybrid
