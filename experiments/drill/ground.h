// The grounds on which the drill paper's claims are measured. Its own 400 × 400 mountains are not public.
#pragma once

#include "experiments/ground.h"

namespace terrabench::drill {

// The ground of the claims and figures: real mountains at the paper's size.
inline constexpr std::string_view kMainGround = "jacksboro-400";

// jacksboro-400, resampled to the paper's 400 × 400; noise-ridges and noise-hills, 400 × 400 whole metres
// from noise. Any other name is opened as a terrain.
TerrainSource open_ground(std::string_view name, std::uint64_t seed);

// Those that the options name; otherwise the main ground, and in the paper profile three more.
std::vector<std::string> grounds(const RunOptions& options);

}  // namespace terrabench::drill
