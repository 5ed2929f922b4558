// Short timed cases are measured a second time, after all others. A machine that others share is slow for
// seconds or minutes at a time: times taken within one such period agree with each other and not with the
// next run's, so that their confidence interval is too narrow. Samples of two periods mend that.
#pragma once

#include <string>

#include "results/record.h"

namespace terrabench {

// The first exact metric that both have and that is not the same, or the pictures; empty if all agree. What
// only one of them has does not count: how many sizes a budget of time allows varies.
std::string exact_difference(const Record& first, const Record& again);

// `first` with the samples of `again` after its own, where they vary from run to run, and with the metrics
// that only `again` has.
Record with_second_look(Record first, const Record& again);

}  // namespace terrabench
