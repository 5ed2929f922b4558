// What each stage of the noise graph of "hybrid" (§3.1.3, figures 3 to 13) does to the stages that it is made
// of, measured on the slices that the figures show.
#pragma once

#include <vector>

#include "experiments/recorder.h"
#include "terrain/progress.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {

// A stage's values in a square picture, rows bottom up; samples are at pixel centres.
struct Pixels {
  int side;
  std::vector<float> values;
  float at(int i, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                  static_cast<std::size_t>(i)];
  }
};

// A vertical slice through the middle of the cube. O(side² · octaves), parallel.
Pixels slice_of(noise::Stage, const noise::CaveOptions&, int side, Progress&);

// Records the measures of the stage, whose slice is `now`. O(side² · octaves)
void compare_stages(noise::Stage, const Pixels& now, const noise::CaveOptions&, Recorder&, Progress&);

}  // namespace terrabench::hybrid
