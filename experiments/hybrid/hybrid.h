// Experiments of "hybrid": layered stacks, an implicit surface, clipmaps and grass, with terrain from 3-D
// noise. Here: Table 1 (memory), Table 2 (generation time), the cave claims of §3.1.3 and figures 3 to 13.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::hybrid {

// The cube of the discrete data structure is n × n × n cells over the same ground, whatever n.
extern const std::span<const ParameterSpec> kSizeParameters;

// Table 1 prints 128, 256 and 512; the quick profile runs 64, 128 and 256.
std::vector<Case> table1_cases(const RunOptions&);
// Bytes of the stacks by the paper's accounting (the fixed part of one array of layers a column), the stacks'
// true heap bytes, a dense grid of one byte a cell, and OpenVDB, all of the same terrain.
void measure_table1(const Case&, const RunOptions&, Recorder&, Progress&);

// As Table 2, and 64 below it, so that the first growth factor can be taken too.
std::vector<Case> table2_cases(const RunOptions&);
// Seconds from noise graph to finished stacks, several samples.
void measure_table2(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kCaveParameters;
std::vector<Case> cave_cases(const RunOptions&);
// Overhanging columns and solid components that float, for each way to combine the noises.
void measure_caves(const Case&, const RunOptions&, Recorder&, Progress&);

extern const std::span<const ParameterSpec> kStageParameters;
std::vector<Case> stage_cases(const RunOptions&);
// One vertical slice of one stage of the noise graph, as figures 3 to 13 show it: white 1, black 0.
void measure_stage(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::hybrid
