// Which cases may record times, and which need a process of their own. Times: those of experiments that
// registry.cpp calls TIMED or FRESH, except where Experiment::times says no.
#pragma once

#include "experiments/experiment.h"

namespace terrabench {

// Whether cases of this registered experiment, or this one of them, record times (is_timing() of a unit):
// they want the machine to themselves. The others may be measured beside each other, since nothing that they
// record depends on what else the machine does.
bool records_times(const Experiment&);
inline bool records_times(const Experiment& experiment, const Case& at) {
  return records_times(experiment) && (experiment.times == nullptr || experiment.times(at));
}

// Whether each case of this registered experiment is measured in a process of its own: one whose times depend
// on where in the heap its memory lies, and so on what the process allocated before.
bool in_fresh_process(const Experiment&);

}  // namespace terrabench
