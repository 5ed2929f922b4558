// Short cases that recorded times are measured a second time, after all others. A machine that others share
// is slow for seconds or minutes at a time: times taken within one such period agree with each other and not
// with the next run's, so that their confidence interval is too narrow. Samples of two periods mend that.
// Where other guests of the machine disturbed one of the two looks alone (interference.h), only the other's
// samples stay.
#pragma once

#include <string>

#include "results/record.h"

namespace terrabench {

// The first exact metric that both have and that is not the same, or the pictures; empty if all agree. What
// only one of them has does not count: some figures are recorded only if the time allows.
std::string exact_difference(const Record& first, const Record& again);

struct Look {
  Record record;
  double loop = 0;  // seconds, the faster of those before and after: a look is disturbed if both were slow
};

// The first look's record with the samples of the second after its own, where they vary from run to run; or
// that of the undisturbed one, if one of them was disturbed. With the metrics that only the other has.
Record with_second_look(Look first, Look again);

}  // namespace terrabench
