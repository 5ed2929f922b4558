// An influence for every drill (Stuetzle & Franklin 2012, §4.1: "every operator will store its own value for
// k").
#pragma once

#include "representations/drill/drills.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// Chooses among about ten influences from 2 to drills.k: the terrain is regenerated with each for all drills,
// and every drill takes that under which the squared error in its largest window adds up to least. Sets
// drills.influence. Costs as many regenerations and O(pixels) each; holds 12 bytes a pixel. Deterministic.
void choose_influence(const Heightfield& field, Drills& drills, Progress* progress = nullptr);

}  // namespace terrabench
