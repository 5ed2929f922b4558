// Experiments of "drill" (Stuetzle & Franklin 2012): terrain from mathematical operators. Here: channel
// networks (figure 1), the factorial of 54 parameter sets and its main effects (figures 3 and 4), what
// extraction and regeneration cost, what the drills take in storage, and the properties that the text claims.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::drill {

// All cases name a ground of ground.h, or any terrain that --terrain gives.
extern const std::span<const ParameterSpec> kChannelParameters;
std::vector<Case> channel_cases(const RunOptions&);
// Channel pixels and the largest flow at one threshold.
void measure_channels(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kFactorialParameters;
std::vector<Case> factorial_cases(const RunOptions&);
// One of the 54 parameter sets: errors in all readings of the two metrics, untouched pixels, pits.
void measure_factorial(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kGroundParameters;
std::vector<Case> ground_cases(const RunOptions&);
// The 54 errors of one ground taken together: the best sets, the main effects, figures 1 to 4 and the maps of
// what differs.
void measure_effects(const Case&, const RunOptions&, Recorder&, Progress&);
// Seconds at several thresholds and the straight line through them.
void measure_time(const Case&, const RunOptions&, Recorder&, Progress&);
// Seconds of each step on grounds of noise from 256² samples up.
extern const std::span<const ParameterSpec> kGrowthParameters;
std::vector<Case> growth_cases(const RunOptions&);
void measure_growth(const Case&, const RunOptions&, Recorder&, Progress&);
// Values and bytes at about 13,000 drills of 160,000 pixels, beside other ways to store the ground.
void measure_size(const Case&, const RunOptions&, Recorder&, Progress&);
// §4.1's future work, each beside the drills without it.
extern const std::span<const ParameterSpec> kExtensionParameters;
std::vector<Case> extension_cases(const RunOptions&);
void measure_extension(const Case&, const RunOptions&, Recorder&, Progress&);
// Order-independence and the other promises of equation 1, and pits left behind.
void measure_promises(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::drill
