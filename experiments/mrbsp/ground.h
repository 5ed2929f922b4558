// Grounds of 65,536 triangles, and walks over them.
#pragma once

#include "experiments/ground.h"
#include "lod/mrbsp/mrbsp.h"
#include "terrain/view.h"

namespace terrabench::mrbsp {

inline constexpr int kSide = 257, kDepth = 16;  // samples; bisections

// Made from a drawing, as the paper's landscape is.
inline constexpr std::string_view kPapersGround = "drawing-257";
// real-257, mountains resampled; drawing-257; rough-257, a fractal.
// Any other name is opened as a terrain of heights, and its holes are filled.
TerrainSource open_ground(std::string_view name, std::uint64_t seed);
// Those that the options name; otherwise real-257 and drawing-257, and rough-257 where asked for.
std::vector<std::string> grounds(const RunOptions&, bool rough);
// The cell below an eye.
glm::ivec2 cell_below(const visibility::CellGrid&, const Heightfield&, const glm::vec3& eye);
// The tree's depth: 16, as in the paper, on ground of 257² samples; otherwise 0: as deep as the samples
// allow.
int depth_over(const Heightfield&);

// Height of a walker's eyes: 1.8 m above both the samples and the triangles drawn from them.
float eye_height(const Heightfield&, float x, float z);
// Metres. A more distant near plane would clip steep ground beside a walker's eye and show what it hides.
inline constexpr float kWalkersNear = 0.02F;
// A closed walk around the middle of the ground at that height, looking ahead, 800 × 600 pixels. The view is
// 40° wide, which shows the paper's 11 % of all triangles. `reach` is the largest distance from the middle,
// as a share of half the extent.
std::vector<View> walk(const Heightfield&, int views, float reach = 0.6F);

// Sizes for Mrbsp::tune(). This one draws the finest triangles at any distance.
inline constexpr double kFinest = 65536;
// In short sides of the finest triangles: with the printed formula, level of detail alone draws about as many
// triangles as the paper's.
inline constexpr double kTunedSize = 16;

// The share of `part` in `whole`, 0 where there is nothing to share.
double share(std::size_t part, std::size_t whole);

double mean_triangles(Mrbsp&, const std::vector<View>&);

}  // namespace terrabench::mrbsp
