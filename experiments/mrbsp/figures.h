// The sheets that the figures of "mrbsp" are written from.
#pragma once

#include <span>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/mrbsp/extruded_profile.h"

namespace terrabench::mrbsp {

// Figure 1 (lod_figure.cpp): the triangles that level of detail of size 1 draws without the extra step
// against holes and with it, with thresholds at vertices, and the triangle that shows the largest hole.
struct LodPanel {
  std::size_t hole_pixels = 0;
  std::size_t bare_pixels = 0;  // by the meter of all methods (bare_pixels.h), which counts hidden holes too
  std::size_t triangles = 0;
};
struct LodSheet {
  figures::Sheet sheet;
  LodPanel without, with;
  // Thresholds of the triangle T: at its right angle, and the lower one of the other two; 0 if there is none.
  int threshold_at_right_angle = 0, threshold_beside = 0;
};
LodSheet lod_sheet(const Heightfield&, const RunOptions&, Progress&);

// Figure 2 and table 1 (profile_figures.cpp). The table has printed and computed rows side by side, for all
// steps in either.
struct ProfileSheet {
  figures::Sheet sheet;
  int fine_segments = 0, coarse_segments = 0, cells = 0, dark_cells = 0;  // drawn
};
ProfileSheet profile_sheet(std::span<const float> profile, std::span<const ProfileStep>);
figures::Sheet table_sheet(std::span<const PrintedStep>, std::span<const ProfileStep>);

}  // namespace terrabench::mrbsp
