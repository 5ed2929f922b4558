// The drill paper's figures 1 to 3, in its layout, and maps of the error of regeneration.
#pragma once

#include <string>

#include "experiments/drill/factorial.h"
#include "experiments/recorder.h"

namespace terrabench::drill {

struct Study {
  const Heightfield& ground;
  const FlowNetwork& network;
  std::string name;    // for captions
  std::string suffix;  // of figure ids; empty for the main ground
};

void draw_channels(const Study&, Recorder&);        // figure 1
void draw_cross_sections(const Study&, Recorder&);  // figure 2
// Figure 3, and the difference from the ground as a figure of its own.
void draw_best(const Study&, const Outcome& least_rmse, const Outcome& least_ahd, Recorder&);

}  // namespace terrabench::drill
