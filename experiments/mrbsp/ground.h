// Land of 65,536 triangles, and walks over it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/experiment.h"
#include "lod/mrbsp/mrbsp.h"
#include "terrain/source.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

inline constexpr int kSide = 257, kDepth = 16;  // samples; bisections

// real-257, mountains resampled; drawing-257, made as the paper makes its own; rough-257, a fractal. Any
// other name is opened as a terrain of heights, holes filled.
TerrainSource open_ground(std::string_view name, std::uint64_t seed);
// Those that the options name; otherwise the first two, or all three.
std::vector<std::string> grounds(const RunOptions&, bool rough);
// The paper's depth on land of its size; otherwise as deep as the samples go.
int depth_over(const Heightfield&);

// Height of a walker's eyes: 1.8 m above the samples and the triangles drawn of them.
float eye_height(const Heightfield&, float x, float z);
// Metres. A farther near plane would cut away steep ground beside a walker's eye and show what it hides.
inline constexpr float kWalkersNear = 0.02F;
// Loops around the middle of the land at that height, looking ahead, 800 × 600 pixels. 40° across, which
// sees the paper's 11 % of all triangles. `reach` is how far from the middle it goes, in shares of half the
// land.
std::vector<View> walk(const Heightfield&, int views, float reach = 0.6F);

// All triangles of the land at any distance, or as the rule says.
inline constexpr double kFinest = 65536;
// The least distance over which the printed formula lets triangles be coarser, in short sides of the finest:
// where level of detail alone draws about as many as the paper's.
inline constexpr double kTunedSize = 16;

double mean_triangles(Mrbsp&, const std::vector<View>&);

}  // namespace terrabench::mrbsp
