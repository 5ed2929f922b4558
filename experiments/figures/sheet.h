// A sheet of pictures, lines and text, for figures that are not charts. Positions are in units from the top
// left corner; a unit is two pixels of the image file.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "results/plot/figure_layout.h"
#include "results/plot/plot.h"
#include "results/plot/rasterise.h"
#include "terrain/image.h"

namespace terrabench::figures {

struct SheetPoint {
  double x, y;
};

struct Stroke {
  Rgb colour{0, 0, 0};
  double thickness = 1, opacity = 1;
  std::string_view dashes = "";  // lengths of dashes and gaps, as in SVG; empty: a solid line
};

class Sheet {
 public:
  static constexpr int kPixels = 2;  // per unit

  Sheet(double width, double height);

  void box(double x, double y, double width, double height, Rgb fill);
  void line(std::span<const SheetPoint> points, const Stroke&);
  void stroke(SheetPoint from, SheetPoint to, Rgb colour, double thickness);
  // Marks for points; `radius` is in units. A ring is filled with white.
  void dot(SheetPoint, double radius, Rgb colour);
  void ring(SheetPoint, double radius, Rgb colour, double thickness);
  void cross(SheetPoint, double radius, Rgb colour);
  void star(SheetPoint, double radius, Rgb colour);
  // `anchor` is start, middle or end.
  void text(double x, double y, std::string_view words, int size, std::string_view anchor = "start",
            Rgb colour = {32, 32, 32});
  // Pixels become sharp rectangles, all of the same size if the image is enlarged by a whole number.
  // Each is a panel of the figure's layout (results/plot/figure_layout.h); the words are those of text().
  void picture(double x, double y, double width, double height, const Image& image);
  // Makes a part of the sheet that consists of lines, boxes and words a panel of the layout too.
  void panel(double x, double y, double width, double height);
  // The colours of 0 to 1 from left to right, with words below the bar at each tick.
  struct Tick {
    double at;  // 0 to 1
    std::string words;
  };
  void colour_bar(double x, double y, double width, const std::function<Rgb(double)>& colour,
                  std::span<const Tick> ticks);
  std::string svg() const;
  const FigureLayout& layout() const { return layout_; }
  // Throws as write_svg().
  void write(const FigureFile&) const;

 private:
  void image(double x, double y, double width, double height, const Image& image);
  void circle(SheetPoint centre, double radius, Rgb colour, double thickness);
  // `count` strokes through the centre, evenly spaced over half a turn; the first is turned by `first` half
  // turns.
  void rays(SheetPoint centre, double radius, int count, double first, Rgb colour);

  int width_, height_;
  std::string body_;
  FigureLayout layout_;
};

// Writes a chart: a figure of one panel, with the words that the chart shows. `width` is in pixels. Throws
// as plot_svg() and write_svg().
void write_chart(const FigureFile&, const Plot&, int width);

// A picture with its words.
struct Panel {
  Image image;
  std::string words;
  double scale = 1.0 / Sheet::kPixels;  // units of the sheet per pixel of the image
  double width() const { return scale * image.width; }
  double height() const { return scale * image.height; }
};

}  // namespace terrabench::figures
