// The sheets that the figures of "mrbsp" are written from.
#pragma once

#include <span>

#include "experiments/experiment.h"
#include "experiments/figures/sheet.h"
#include "experiments/mrbsp/extruded_profile.h"
#include "lod/mrbsp/mrbsp.h"
#include "results/plot.h"
#include "terrain/image.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

// Figure 1 (lod_figure.cpp): the triangles that `lod` draws in the view, with thresholds at vertices and the
// largest triangle in sight that the one-vertex rule splits. The view must have the sheet's size, as
// lod_view() does. Throws as open_context() does.
View lod_view(const Heightfield&, const Mrbsp&);
figures::Sheet lod_sheet(const Heightfield&, Mrbsp&, const View&, const RunOptions&);

// Figure 2 and table 1 (profile_figures.cpp). The table has printed and computed rows side by side, for all
// steps in either.
figures::Sheet profile_sheet(std::span<const float> profile, std::span<const ProfileStep>);
figures::Sheet table_sheet(std::span<const PrintedStep>, std::span<const ProfileStep>);

// Apparent size of triangles against distance on level ground of side² samples (threshold.cpp): the formula
// as printed, then the one for areas. Labels give the slopes.
Heightfield level_ground(int side);
Plot threshold_plot(const Heightfield& level, Progress&);

// A drawing and the land made from it (landscape.cpp). Throws as open_context() does.
figures::Sheet landscape_sheet(const Image& drawing, const Heightfield& land, const RunOptions&);

}  // namespace terrabench::mrbsp
