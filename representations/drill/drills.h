// A terrain as drill operations on a plateau (Stuetzle & Franklin 2012, "Representing terrain with
// mathematical operators"): for every channel pixel a shape D(r) = elevation + slope·r + curvature·r², r the
// distance from the pixel in samples, cut into the terrain above it within a square window (eq. 1). 12 bytes
// of shape and 5 of position per drill; files of shapes with their vertex at the pixel hold no slope.
//
// Distances are counted in samples, as the paper does, also where cells are not square.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace terrabench {

// Samples without data: `count` pixels in row-major order from `first`.
struct HoleRun {
  std::uint32_t first, count;
  bool operator==(const HoleRun&) const = default;
};

// All that regeneration needs. Drills are in row-major order of their pixels.
struct Drills {
  static constexpr int kMaxInfluence = 255;

  int width = 0, depth = 0;
  float cell_x = 1, cell_z = 1;  // metres
  float plateau = 0;             // max(T), metres
  int w = 1;                     // samples: length of the cross-sections that gave the shapes
  int k = 0;          // influence: windows are 2k + 1 samples wide; the largest where `influence` is given
  float quantum = 0;  // see quantise() in quantum.h; 0 when nothing is rounded
  bool interpolated = false;  // pixels that no drill touches are interpolated

  std::vector<std::uint32_t> pixel;
  std::vector<std::uint8_t> direction;  // to the drill downstream (kFlowSteps), or FlowNetwork::kOutlet
  std::vector<float> elevation;         // metres
  std::vector<float> slope;             // metres per sample
  std::vector<float> curvature;         // metres per sample²
  std::vector<std::uint8_t> influence;  // k of each drill; empty when all have `k`
  std::vector<HoleRun> holes;

  std::size_t count() const { return pixel.size(); }
  std::size_t pixels() const { return static_cast<std::size_t>(width) * depth; }
  int influence_of(std::size_t drill) const { return influence.empty() ? k : influence[drill]; }
  bool operator==(const Drills&) const = default;
};

}  // namespace terrabench
