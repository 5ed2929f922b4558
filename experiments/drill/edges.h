// Steps of height between neighbouring samples where drills end (Stuetzle & Franklin 2012, §2 and §4:
// discontinuities "can exist at the edge of, and on the border between, two drills").
#pragma once

#include <cstddef>

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"

namespace terrabench::drill {

// Over pairs of samples side by side (4-neighbours), both with data, in metres.
struct Steps {
  double largest = 0, mean = 0;
  std::size_t pairs = 0;
};

Steps steps(const Heightfield& field);  // O(samples)

// Steps of the regenerated terrain, split by what shaped the two samples. The drill that cut deepest shapes a
// sample; a pair lies across a window's border if one of the two lies outside the window of the drill that
// shaped the other. Every pair is in one of the two. O(drills · (2k + 1)²).
struct EdgeSteps {
  Steps across, inside;
};
EdgeSteps edge_steps(const Drills& drills);

}  // namespace terrabench::drill
