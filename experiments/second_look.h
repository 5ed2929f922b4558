// Short cases that recorded times, except those of in_fresh_process() (timing.h), are measured a second time,
// after all others. A machine that others share is slow for seconds or minutes at a time: times taken within
// one such period agree with each other and not with the next run's, so that their confidence interval is too
// narrow. Samples of two periods mend that.
// Where other guests of the machine disturbed one of the two looks alone (interference.h), only the other's
// samples stay.
#pragma once

#include <string>

#include "results/store/record.h"

namespace terrabench {

// The first metric that only one of them has or that is exact and not the same, or the pictures; empty if all
// agree.
std::string exact_difference(const Record& first, const Record& again);

struct Look {
  Record record;
  double loop = 0;  // seconds, the faster of those before and after: a look is disturbed if both were slow
};

// Of two looks without exact_difference(): the first one's record with the samples of the second after its
// own, where they vary from run to run; or that of the undisturbed one, if one of them was disturbed.
Record with_second_look(Look first, Look again);

}  // namespace terrabench
