// A sheet of panels, lines and lettering for figures that no chart draws. Positions in pixels from the top
// left.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "terrain/heightfield.h"
#include "terrain/image.h"

namespace terrabench::drill {

struct SheetPoint {
  double x, y;
};

class Sheet {
 public:
  Sheet(int width, int height) : width_(width), height_(height) {}

  void box(double x, double y, double width, double height, Rgb fill);
  void line(std::span<const SheetPoint> points, Rgb colour, double thickness, double opacity = 1);
  // `anchor` is start, middle or end.
  void text(double x, double y, std::string_view words, int size, std::string_view anchor = "start",
            Rgb colour = {32, 32, 32});
  // Each pixel a sharp square when enlarged.
  void picture(double x, double y, double width, double height, const Image& image);
  // As PNG, twice as many pixels as the sheet is wide. Throws environment_error.
  void write(const std::filesystem::path& png) const;

 private:
  int width_, height_;
  std::string body_;
};

// The paper's colours of heights: blue, green, brown, white upward, 0 … 1.
Rgb height_colour(double t);
// Blue for 0, red for 1, as in figure 4.
Rgb error_colour(double t);

// The ground from above, one pixel a sample, lit from the north-west; coloured between the two heights, grey
// when they are equal. No-data is white.
Image relief(const Heightfield& field, double lowest, double highest);

}  // namespace terrabench::drill
