// The hybrid paper's cave terrain (§3.1.3): a vertical gradient cut into ground and sky, shifted in y by a
// fractal that ignores y (hills), in x by one that does not (overhangs), and hollowed by two ridged
// multifractals (tunnels) that fade with height. Six octaves in each of the five fractals.
//
// About 24 million samples per second and core on a 512³ grid with AVX-512, 15 with AVX2: parts that are
// provably air or ground are not evaluated.
#pragma once

#include <cstdint>
#include <string_view>

#include "terrain/solid.h"
#include "terrain/source.h"
#include "terrain/sources/noise/graph.h"

namespace terrabench::noise {

struct CaveOptions {
  std::uint64_t seed = 1;
  float extent = 128.0F;  // metres, side of the cube; features scale with it
  bool perturb_x = true;  // overhangs
  bool caves = true;
  bool attenuation = true;  // caves fade with height
  // The paper multiplies two maps that are 0 in caves; the product is 0 where either is, yet the text says
  // that caves form only where both are. By default both must be 0, which gives tunnels; with this option the
  // product as printed, which gives sheets that cut the ground apart.
  bool printed_product = false;
  // One fractal distorts both cave maps. Otherwise each has its own: similar caves, with a sixth fractal. The
  // printed product always shares it.
  bool share_roughness = true;
  // Evaluates all fractals in every cell, as the paper's implementation does: the same terrain, more slowly.
  bool every_cell = false;
};

// The stages of the paper's figures 3 to 13. Its captions 9 and 10 are swapped: by the text, followed here,
// the noise comes first and is then clamped. In the cave maps, as in the paper, 0 is a cave. The figures are
// two-dimensional and have one ridged multifractal, the first; the terrain in space has both.
enum class Stage : std::uint8_t {
  kGradient,         // figure 3: 0 at the top, 1 at the bottom
  kClampedGradient,  // 4: ground 1, sky 0
  kFbm,              // 5
  kFlatFbm,          // 6: sampled at y = 0
  kYPerturbed,       // 7
  kXYPerturbed,      // 8
  kRidged,           // 9 in the text
  kClampedRidged,    // 10 in the text
  kPerturbedRidged,  // 11
  kMultiplied,       // 12: figure 8 times figure 11
  kAttenuated,       // 13: the same with caves that fade with height
};
inline constexpr int kStages = 11;

struct StageInfo {
  Stage stage;
  int figure;  // in the paper, by its text
  std::string_view name;
  float low, high;  // range of the values: what to show as black and white
};
const StageInfo& info(Stage stage);

struct CaveGraph {
  Graph graph;
  Node root;
};

// The stage's graph; of the options only seed and extent matter.
CaveGraph graph_for(Stage stage, const CaveOptions& options);

// Throws usage_error when the extent is not a positive number. Safe to sample from many threads.
Solid cave_terrain(const CaveOptions& options = {});

// The same as a source for structures.
TerrainSource cave_source(const CaveOptions& options = {});

}  // namespace terrabench::noise
