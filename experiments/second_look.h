// Short timed cases are measured a second time, after all others. A machine that others share is slow for
// seconds or minutes at a time: times taken within one such stretch agree with each other and not with the
// next run's, and their confidence interval would not show it. Times of two stretches do.
#pragma once

#include "results/record.h"

namespace terrabench {

// `first` with the samples of `again` after its own, where they vary from run to run. What is exact must be
// the same in both, metrics and pictures: throws Error(kEnvironment), which names the first that is not.
Record with_second_look(Record first, const Record& again);

}  // namespace terrabench
