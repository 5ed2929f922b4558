// Experiments of "ght" (Alonso, Joan-Arinyo & Solano): the grounded heightmap tree. Here: the generators of
// its base terrains (§2.3), what they promise, and figures 1 and 3 to 10 step by step.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::ght {

extern const std::span<const ParameterSpec> kGeneratorParameters;
std::vector<Case> generator_cases(const RunOptions&);
// How many samples of each generator break what §2.3 says of it, and how its result depends on the seed.
void measure_generator(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kStageParameters;
std::vector<Case> stage_cases(const RunOptions&);
// One figure of §2 each, in the paper's layout, from the generators' own stages.
void draw_stage(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::ght
