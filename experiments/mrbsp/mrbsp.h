// Experiments of "mrbsp": land from drawings, level of detail by a bisection tree, and visibility from the
// ground found beforehand. All of the paper's numbers belong to one landscape of 65,536 triangles that is not
// public; ours have as many.
#pragma once

#include <span>
#include <vector>

#include "experiments/experiment.h"

namespace terrabench::mrbsp {

// §2: whether every level is the whole land, and how the recursion as printed tears its vertices.
extern const std::span<const ParameterSpec> kHeightParameters;
std::vector<Case> height_cases(const RunOptions&);
void measure_heights(const Case&, const RunOptions&, Recorder&, Progress&);

// Table 2: triangles and times of level of detail, visibility, both and neither, along a walk.
extern const std::span<const ParameterSpec> kWalkParameters;
std::vector<Case> walk_cases(const RunOptions&);
void measure_walk(const Case&, const RunOptions&, Recorder&, Progress&);

// §3: the apparent size of triangles against distance, by the formula as printed and by the one for areas.
extern const std::span<const ParameterSpec> kThresholdParameters;
std::vector<Case> threshold_cases(const RunOptions&);
void measure_threshold(const Case&, const RunOptions&, Recorder&, Progress&);

// §3: holes left by the printed rule and by the conforming one.
extern const std::span<const ParameterSpec> kHoleParameters;
std::vector<Case> hole_cases(const RunOptions&);
void measure_holes(const Case&, const RunOptions&, Recorder&, Progress&);
// Figure 1.
std::vector<Case> lod_figure_cases(const RunOptions&);
void draw_lod_figure(const Case&, const RunOptions&, Recorder&, Progress&);

// §4: what the stored sets miss, and their bytes.
extern const std::span<const ParameterSpec> kVisibilityParameters;
std::vector<Case> visibility_cases(const RunOptions&);
void measure_visibility(const Case&, const RunOptions&, Recorder&, Progress&);
// Table 1 and figure 2.
std::vector<Case> profile_cases(const RunOptions&);
void measure_profile(const Case&, const RunOptions&, Recorder&, Progress&);

// §5: gains against the size and the roughness of the land.
extern const std::span<const ParameterSpec> kLandParameters;
std::vector<Case> land_cases(const RunOptions&);
void measure_land(const Case&, const RunOptions&, Recorder&, Progress&);
extern const std::span<const ParameterSpec> kRoughnessParameters;
std::vector<Case> roughness_cases(const RunOptions&);
void measure_roughness(const Case&, const RunOptions&, Recorder&, Progress&);

// §1: what drawings become.
extern const std::span<const ParameterSpec> kDrawingParameters;
std::vector<Case> drawing_cases(const RunOptions&);
void measure_drawing(const Case&, const RunOptions&, Recorder&, Progress&);

}  // namespace terrabench::mrbsp
