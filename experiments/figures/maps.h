// Maps of ground seen from above, in a grid of panels with a title over each and keys below; the colours and
// the light of figures. Readers with the common kinds of colour blindness can tell the colours apart: where
// hue has a meaning it runs between blue and orange or red, and lightness changes with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/sheet.h"
#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::figures {

// Marks on maps coloured by elevation: channel pixels, and samples that no drill reaches.
inline constexpr Rgb kChannel{0, 56, 168}, kUntouched{120, 120, 128};

// Blue at t = 0, the lowest height, over green and brown to white at 1, the highest, as in figure 1 of
// "drill"; light enough for lines and shading on top.
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

// Pictures of one size with their words as titles, `width` units wide, in rows of `columns`; `below` units of
// space below each.
Sheet titled_sheet(int columns, double width, double below, const std::vector<Panel>&);

// Words at x, and a colour bar at x + `indent`, with two or more labels at equal distances.
void add_colour_key(Sheet&, double x, double y, std::string_view words, double indent, double width,
                    const std::function<Rgb(double)>& colour, const std::vector<std::string>& labels);

// The end of the id of a figure that is drawn once per ground: empty for the main ground, which stands for
// the paper's own; ".name" for others. A path is named by its ground_id() (results/report/ground_name.h):
// DEMs of one file name must not draw into one file.
std::string ground_suffix(std::string_view ground, std::string_view main_ground);

}  // namespace terrabench::figures
