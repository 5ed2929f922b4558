// Flow routing by least-cost search from the border (Stuetzle & Franklin 2012, §2.1; Metz, Mitasova & Harmon
// 2011; D8 of O'Callaghan & Mark 1984). Every pixel drains to exactly one of its 8 neighbours or out of the
// terrain, and all flow ends in an outlet: pits do not trap it.
//
// The rule. Border pixels, which are those on the grid's edge and those with a no-data neighbour, enter the
// search queue in row-major order. The search takes the lowest pixel of the queue, the earliest of equal
// ones; each neighbour not met before drains to it and joins the queue, in the order of kFlowSteps. A border
// pixel likewise drains to the first pixel taken beside it if that one is strictly lower; border pixels
// without such a neighbour are the outlets. The result is the same on every machine.
//
// O(n) when all heights are whole numbers in a range below 2^20 (every int16 DEM), otherwise O(n log n) at
// worst and nearly O(n) for terrain (pixel_queues.h). Holds 4 or 8 bytes per pixel beside the result.
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
  // The number of pixels that drain through each, itself included; 0 without data. The outlets' values add up
  // to the number of pixels with data.
  std::vector<std::uint32_t> accumulation;

  std::size_t size() const { return direction.size(); }
  bool flows(std::size_t pixel) const { return direction[pixel] < kOutlet; }
  // The pixel that `pixel` drains to; needs flows(pixel).
  std::size_t receiver(std::size_t pixel) const {
    const FlowStep step = kFlowSteps[direction[pixel]];
    return pixel + static_cast<std::ptrdiff_t>(step.z) * width + step.x;
  }
};

// Throws Error(kInterrupted). The field must have fewer than 2^31 samples, with a rim of one sample fewer
// than 2^32.
FlowNetwork route_flow(const Heightfield& field, Progress* progress = nullptr);

}  // namespace terrabench
