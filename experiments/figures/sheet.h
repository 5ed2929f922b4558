// A sheet of panels, lines and lettering for figures that no chart draws. Positions in units from the top
// left; a unit is two pixels of the picture.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "terrain/image.h"

namespace terrabench::figures {

struct SheetPoint {
  double x, y;
};

struct Stroke {
  Rgb colour{0, 0, 0};
  double thickness = 1, opacity = 1;
  std::string_view dashes = "";  // lengths of strokes and gaps, as SVG has them; empty: none
};

class Sheet {
 public:
  static constexpr int kPixels = 2;  // a unit

  Sheet(double width, double height);

  void box(double x, double y, double width, double height, Rgb fill);
  void line(std::span<const SheetPoint> points, const Stroke&);
  // `anchor` is start, middle or end.
  void text(double x, double y, std::string_view words, int size, std::string_view anchor = "start",
            Rgb colour = {32, 32, 32});
  // Each pixel of the image a sharp rectangle where it is enlarged by whole numbers, as near as that goes.
  void picture(double x, double y, double width, double height, const Image& image);
  // Colours from 0 to 1 from left to right, with words below at these places of it.
  struct Tick {
    double at;
    std::string words;
  };
  void colour_bar(double x, double y, double width, const std::function<Rgb(double)>& colour,
                  std::span<const Tick> ticks);
  // As PNG. Throws environment_error.
  void write(const std::filesystem::path& png) const;

 private:
  int width_, height_;
  std::string body_;
};

}  // namespace terrabench::figures
