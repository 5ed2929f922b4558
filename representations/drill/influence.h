// An influence for every drill (Stuetzle & Franklin 2012, §4.1: "every operator will store its own value for
// k").
#pragma once

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// Chooses from about ten influences between 2 and drills.k: the terrain is regenerated with each for all
// drills, and every drill takes the one with the least squared error in the drill's largest window. Sets
// drills.influence. Costs one regeneration and O(pixels) per influence; holds 12 bytes per pixel.
// Deterministic.
void choose_influence(const Heightfield& field, Drills& drills, Progress* progress = nullptr);

}  // namespace terrabench
