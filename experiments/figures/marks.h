// Marks on a sheet, for points of a grid: strokes, dots, rings, crosses and stars. Sizes in units of the
// sheet.
#pragma once

#include "experiments/figures/sheet.h"

namespace terrabench::figures {

void draw_stroke(Sheet&, SheetPoint from, SheetPoint to, Rgb colour, double thickness);
void draw_dot(Sheet&, SheetPoint, double radius, Rgb colour);
void draw_ring(Sheet&, SheetPoint, double radius, Rgb colour, double thickness);  // white inside
void draw_cross(Sheet&, SheetPoint, double radius, Rgb colour);
void draw_star(Sheet&, SheetPoint, double radius, Rgb colour);

}  // namespace terrabench::figures
