// Flow routing by least-cost search from the border (Stuetzle & Franklin 2012, §2.1; Metz, Mitasova & Harmon
// 2011; D8 of O'Callaghan & Mark 1984). Every pixel drains to exactly one of its 8 neighbours or out of the
// terrain, and all flow ends in an outlet: pits cannot trap it.
//
// The rule. Border pixels, which are those on the grid's edge and those with a no-data neighbour, enter the
// search in row-major order. The search takes the lowest pixel of those that wait, of equal ones that which
// has waited longest, and lets each neighbour not met before drain to it, in the order of kFlowSteps; these
// then wait in turn. A border pixel drains likewise to the first pixel taken beside it if that one is
// strictly lower; border pixels without such a neighbour are the outlets. The result is the same on every
// machine.
//
// O(n) when all heights are whole numbers in a range below 2^20 (every int16 DEM), otherwise O(n log n) at
// worst and nearly O(n) for terrain (pixel_queues.h). Holds 4 or 8 bytes a pixel beside the result.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench {

// Steps to the 8 neighbours: E, SE, S, SW, W, NW, N, NE. The opposite of direction d is d ^ 4.
struct FlowStep {
  int x, z;
};
inline constexpr std::array<FlowStep, 8> kFlowSteps{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

struct FlowNetwork {
  static constexpr std::uint8_t kOutlet = 8;    // drains out of the terrain
  static constexpr std::uint8_t kNoData = 255;  // the pixel holds no height

  int width = 0, depth = 0;
  std::vector<std::uint8_t>
      direction;  // row-major: index into kFlowSteps of the neighbour drained to, or above
  // How many pixels drain through each, itself included; 0 without data. The outlets' values add up to the
  // number of pixels with data.
  std::vector<std::uint32_t> accumulation;

  std::size_t size() const { return direction.size(); }
  bool flows(std::size_t pixel) const { return direction[pixel] < kOutlet; }
  // The pixel drained to, of one that flows().
  std::size_t receiver(std::size_t pixel) const {
    const FlowStep step = kFlowSteps[direction[pixel]];
    return pixel + static_cast<std::ptrdiff_t>(step.z) * width + step.x;
  }
};

// Throws Error(kInterrupted). The field must have fewer than 2^31 samples, with a rim of one around it fewer
// than 2^32.
FlowNetwork route_flow(const Heightfield& field, Progress* progress = nullptr);

// Pixels with accumulation ≥ tau (τ ≥ 1), upstream before downstream, chain by chain: heads in row-major
// order, each followed downstream until it ends or meets a channel that still lacks one of its tributaries;
// the last tributary to arrive carries on. O(n). The paper has flows "exceed" τ, which is tau = τ + 1 here:
// at 25 and 400² mountains 1.6 % fewer pixels and the same error.
std::vector<std::uint32_t> channel_pixels(const FlowNetwork& network, std::uint32_t tau);

// The network as rasters over the same ground, for write_geotiff(): accumulation (exact up to 2^24 pixels),
// and direction in the powers of two that GIS tools know (E 1, SE 2, S 4 … NE 128, outlets 0).
Heightfield accumulation_raster(const FlowNetwork& network, const Heightfield& ground);
Heightfield direction_raster(const FlowNetwork& network, const Heightfield& ground);

}  // namespace terrabench
