// Small arrays of points as §2.3 of "ght" draws them: dots where points are set, rings, crosses and stars.
#pragma once

#include "experiments/figures/sheet.h"

namespace terrabench::ght {

// Where point (i, j) of an array of `side` × `side` points stands on the sheet.
struct ArrayPlace {
  double x, y, size;  // of the corner point, and of the whole array
  int side;
  figures::SheetPoint at(double i, double j) const {
    return {x + size * i / (side - 1), y + size * j / (side - 1)};
  }
};

void stroke(figures::Sheet&, figures::SheetPoint from, figures::SheetPoint to, Rgb colour, double thickness);
void draw_grid(figures::Sheet&, const ArrayPlace&);  // thin lines between the points
void draw_dot(figures::Sheet&, figures::SheetPoint, double radius, Rgb colour);
void draw_ring(figures::Sheet&, figures::SheetPoint, double radius, Rgb colour,
               double thickness);  // white inside
void draw_cross(figures::Sheet&, figures::SheetPoint, double radius, Rgb colour);
void draw_star(figures::Sheet&, figures::SheetPoint, double radius, Rgb colour);

}  // namespace terrabench::ght
