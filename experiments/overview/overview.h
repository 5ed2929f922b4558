// What the other experiments run on: each terrain drawn from each representation.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::overview_experiments {

extern const std::span<const ParameterSpec> kReliefParameters;
// Every terrain asked for (by default one real DEM and the caves) × every representation.
std::vector<Case> relief_cases(const RunOptions&);
// Builds, draws to PNG; bytes, build time, triangles, and the error against the source.
void measure_relief(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::overview_experiments
