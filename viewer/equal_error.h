// The setting of a method at which its picture has a given error: the experiments' search and meters, for one
// view instead of a path.
#pragma once

#include <memory>
#include <string>

#include "terrain/view.h"
#include "viewer/ground.h"
#include "viewer/method.h"

namespace terrabench::viewer {

struct EqualError {
  Method method;
  std::shared_ptr<Ground> ground;
  double knob = 0, error = 0;  // found: the setting, and the 99th percentile of the visible samples, pixels
  bool reached = false;        // see Tuned (lod/meters/knob_search.h)
};

// With a method of its own, so that the one that is shown is not disturbed. A method without a setting is
// measured only. Costs one build and about six updates and
// measurements, in parallel.
void search(EqualError&, const View&, double pixels, Progress&);
std::string describe(const EqualError&);  // "ROAM 1.98 px at max_error 2.31 px"

}  // namespace terrabench::viewer
