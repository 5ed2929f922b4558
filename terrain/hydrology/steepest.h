// Flow routing by steepest descent (O'Callaghan & Mark 1984, D8), without the search from the border that
// route_flow() (flow.h) adds: one of the two methods whose hybrid Stuetzle & Franklin (2012, §2.1) use.
//
// Every pixel drains to the neighbour with the largest fall per metre of map distance, the first in the order
// of kFlowSteps among equal ones. A pixel without a lower neighbour is an outlet: pits and flats keep their
// flow, so networks break at every pit. O(n), parallel, the same for any number of threads.
#pragma once

#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"

namespace terrabench {

// The field must have fewer than 2^31 samples. Neighbours without data count as absent.
FlowNetwork route_steepest(const Heightfield& field);

}  // namespace terrabench
