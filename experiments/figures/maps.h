// Maps of ground seen from above, in a grid of panels with a title over each and keys below.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/colours.h"
#include "experiments/figures/sheet.h"

namespace terrabench::figures {

// One pixel per sample, in the colour of its height under the light `base` + `by` · light (see lit()); white
// where there is no data. O(samples)
Image shaded_map(const Heightfield&, const Light&, const std::function<Rgb(float)>& colour, double base = 0,
                 double by = 1);

// A grid of pictures of the same size. Lengths are in units of the sheet; panels are numbered row by row.
struct PanelGrid {
  int columns = 2, rows = 1;
  double width = 0, height = 0;  // of a picture
  double gap = 16, below = 16;   // left and right of each column; below each picture
  double title = 26;             // height of the strip over each picture
  int text_size = 13;

  double sheet_width() const { return columns * (width + gap) + gap; }
  double bottom() const { return rows * (title + height + below); }  // lower end of all panels
  double x(int number) const { return gap + number % columns * (width + gap); }
  double y(int number) const { return number / columns * (title + height + below) + title; }
  void place(Sheet&, int number, std::string_view words, const Image&) const;
};

// Words at x, and a colour bar at x + `indent`, with two or more labels at equal distances.
void add_colour_key(Sheet&, double x, double y, std::string_view words, double indent, double width,
                    const std::function<Rgb(double)>& colour, const std::vector<std::string>& labels);

}  // namespace terrabench::figures
