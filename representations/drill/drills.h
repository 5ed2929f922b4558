// A terrain as drill operations on a plateau (Stuetzle & Franklin 2012, "Representing terrain with
// mathematical operators"): for every channel pixel a shape D(r) = elevation + slope·r + curvature·r², r the
// distance from the pixel in samples, cut into all that stands higher within a square window (eq. 1). 12
// bytes of shape and 5 of position a drill.
//
// Distances are counted in samples, as the paper does, also where cells are not square.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/hydrology/flow.h"
#include "terrain/progress.h"

namespace terrabench {

// Samples without data: `count` pixels in row-major order from `first`.
struct HoleRun {
  std::uint32_t first, count;
  bool operator==(const HoleRun&) const = default;
};

// All that regeneration needs. Drills stand in row-major order of their pixels.
struct Drills {
  static constexpr int kMaxInfluence = 255;

  int width = 0, depth = 0;
  float cell_x = 1, cell_z = 1;  // metres
  float plateau = 0;             // max(T), metres
  int w = 1;                     // how far, in samples, the terrain was looked at for the shapes
  int k = 0;                     // influence: windows are 2k + 1 samples wide; the largest, with `influence`
  float quantum = 0;             // see quantise() in drill_codec.h; 0 when nothing is rounded
  bool interpolated = false;     // pixels that no drill touches take after those around them

  std::vector<std::uint32_t> pixel;
  std::vector<std::uint8_t> direction;  // to the drill downstream (kFlowSteps), or FlowNetwork::kOutlet
  std::vector<float> elevation;         // metres
  std::vector<float> slope;             // metres a sample
  std::vector<float> curvature;         // metres a sample²
  std::vector<std::uint8_t> influence;  // k of each drill; empty when all have `k`
  std::vector<HoleRun> holes;

  std::size_t count() const { return pixel.size(); }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * depth; }
  int influence_of(std::size_t drill) const { return influence.empty() ? k : influence[drill]; }
};

struct DrillOptions {
  std::uint32_t tau = 25;  // least flow of a channel, pixels
  int w = 10;              // length of a cross-section, samples
  int k = 10;              // influence, samples
  // Shapes never fall from the centre outward, as the paper's §4 says of them: slope and curvature ≥ 0.
  // Without, the fit is the one printed in §2.2, whose parabolas may bend down; beyond w they then fall
  // without end.
  bool monotone = true;
  // Another reading of monotone: shapes may bend as long as they do not fall within window or cross-section.
  bool window_only = false;
  // §4.1: elevations never rise downstream. With shapes monotone everywhere no pit can be left (pits.h).
  bool monotone_profiles = false;
  bool adaptive_k = false;             // §4.1: a k of its own for every drill, up to `k` (influence.h)
  bool interpolate_untouched = false;  // §4.1: see regenerate.h
};

// Throws usage_error: τ < 1, w < 1 or larger than the terrain, w or k above 255, k < 0.
void check_options(const DrillOptions&, int width, int depth);

// Drills for all pixels whose flow is at least τ; none when no flow is. `network` is route_flow(field);
// heights are below 10⁹ m. O(pixels + drills · w), parallel over drills, the same on every machine.
Drills extract_drills(const Heightfield& field, const FlowNetwork& network, const DrillOptions& options,
                      Progress* progress = nullptr);

}  // namespace terrabench
