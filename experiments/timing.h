// Which experiments record times, as registry.cpp says.
#pragma once

#include "experiments/experiment.h"

namespace terrabench {

// Whether cases of this registered experiment record times (is_timing() of a unit): they want the machine to
// themselves. Those of the others may be measured beside each other, since nothing that they record depends on
// what else the machine does.
bool records_times(const Experiment&);

}  // namespace terrabench
