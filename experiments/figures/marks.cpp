#include "experiments/figures/marks.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace terrabench::figures {
namespace {

void circle(Sheet& sheet, SheetPoint centre, double radius, Rgb colour, double thickness) {
  constexpr int kCorners = 32;
  std::vector<SheetPoint> points;
  for (int k = 0; k <= kCorners + 1; ++k) {  // one corner past the first, so that the ends join
    const double angle = 2 * std::numbers::pi * k / kCorners;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  sheet.line(points, {.colour = colour, .thickness = thickness});
}

// `count` strokes through the centre, evenly turned, the first by `first` half turns.
void rays(Sheet& sheet, SheetPoint centre, double radius, int count, double first, Rgb colour) {
  for (int k = 0; k < count; ++k) {
    const double angle = std::numbers::pi * (first + static_cast<double>(k) / count);
    const double dx = radius * std::cos(angle), dy = radius * std::sin(angle);
    draw_stroke(sheet, {centre.x - dx, centre.y - dy}, {centre.x + dx, centre.y + dy}, colour, radius / 3);
  }
}

}  // namespace

void draw_stroke(Sheet& sheet, SheetPoint from, SheetPoint to, Rgb colour, double thickness) {
  sheet.line(std::array{from, to}, {.colour = colour, .thickness = thickness});
}

// A wide stroke along a circle of about half the radius fills the disc, its centre included.
void draw_dot(Sheet& sheet, SheetPoint centre, double radius, Rgb colour) {
  circle(sheet, centre, 0.45 * radius, colour, 1.1 * radius);
}

void draw_ring(Sheet& sheet, SheetPoint centre, double radius, Rgb colour, double thickness) {
  draw_dot(sheet, centre, radius, {255, 255, 255});
  circle(sheet, centre, radius, colour, thickness);
}

void draw_cross(Sheet& sheet, SheetPoint centre, double radius, Rgb colour) {
  rays(sheet, centre, radius, 2, 0.25, colour);
}

void draw_star(Sheet& sheet, SheetPoint centre, double radius, Rgb colour) {
  rays(sheet, centre, radius, 3, 0.5, colour);
}

}  // namespace terrabench::figures
