// What a method costs along a whole path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiments/cross/lod/flight.h"

namespace terrabench::cross {

// Over every frame of a path, with nothing between two updates. The first update, which builds what later
// ones keep, is reported separately.
struct PathCost {
  double build_time = 0, first_update_time = 0;  // seconds
  std::size_t first_uploaded = 0;                // bytes
  double uploaded = 0;                           // bytes per frame, mean
  std::vector<double> times, triangles;          // per frame: seconds, triangles drawn
  std::size_t bytes_held = 0;                    // by the method's own count, after the path
  std::int64_t heap_growth = 0;                  // by the count of operator new
};

// Builds the method, sets its knob and updates it for every view of the flight.
PathCost fly(const Flight&, const Contender&, double knob, Progress&);

}  // namespace terrabench::cross
