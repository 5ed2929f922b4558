// A clipmap over ground that no memory should have to hold: made row by row, cut into a pyramid of tiles on
// disk, and walked over by a process of its own, so that its resident memory is its own too.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::cross {

extern const std::span<const ParameterSpec> kLodDiskParameters;
// Synthetic mountains of 4096² and, in the paper profile, 16384² samples; or each terrain that is asked for.
// A folder among these is a pyramid (terrain/sources/dem/height_pyramid.h) and is walked in this very
// process.
std::vector<Case> lod_disk_cases(const RunOptions&);
// Peak resident bytes, time of update(), tiles decoded, and bytes uploaded beside those of the L-shaped
// strips. What it puts into the temporary folder, 2 bytes or so a sample, is gone when it returns or throws.
void measure_lod_disk(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::cross
