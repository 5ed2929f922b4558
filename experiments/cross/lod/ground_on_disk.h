// Ground that is made on disk and never whole in memory, and the peak memory of the process that moves over
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::cross {

// Of the mountains that cases without a terrain make: `side`.
inline const ParameterSpec kMountainsSide{
    "side", std::int64_t{4096}, "samples", "side of the synthetic mountains", 2, 32768};

// One per terrain; without terrains, mountains of 4096² samples and beyond the quick profile of 16384².
std::vector<Case> cases_on_disk(std::span<const ParameterSpec>, const RunOptions&);

// The pyramid of the case's ground (HeightPyramid), which is recorded: the case's own folder if its terrain
// is one, else made in `folder`.
std::filesystem::path pyramid_of(const Case&, const RunOptions&, const std::filesystem::path& folder,
                                 Recorder&, Progress&);

// Peak resident memory of this process (Linux: VmHWM) since forget_peak(). Throws environment_error where the
// system does not report it.
std::uint64_t peak_resident_bytes();
// Gives back what was freed, so that the peak is that of what follows.
void forget_peak();

}  // namespace terrabench::cross
