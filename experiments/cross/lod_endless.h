// A clipmap over ground without bounds (the endless terrain of the hybrid paper, §3.2): a straight flight,
// back home the same way, and what it cost and showed.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::cross {

extern const std::span<const ParameterSpec> kLodEndlessParameters;
// One flight over noise, at home and, in a second case, so far from sample 0 that a float no longer tells one
// sample from the next. Takes no terrain: the ground is made as it is met.
std::vector<Case> lod_endless_cases(const RunOptions&);
// Time of update(), bytes uploaded beside those of the strips that the eye's path asks for, bytes held,
// cracks and edges in view, heights that differ on the way back; and a picture of the horizon.
void measure_lod_endless(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::cross
