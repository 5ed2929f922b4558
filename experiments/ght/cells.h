// Topics of the experiment "ght.cells" that have files of their own.
#pragma once

#include "experiments/experiment.h"

namespace terrabench::ght {

void measure_interpolated(const RunOptions&, Recorder&);  // interpolated.cpp
void measure_null_links(const RunOptions&, Recorder&);    // null_links.cpp

}  // namespace terrabench::ght
