#include "representations/drill/pits.h"

#include <cstdint>
#include <vector>

#include "terrain/hydrology/flow.h"

namespace terrabench {
namespace {

// Whether water leaves a flat from this pixel. Appends the pixels of the flat around it that are not `seen`.
bool drains(const Heightfield& field, std::size_t pixel, std::vector<std::uint8_t>& seen,
            std::vector<std::size_t>& flat) {
  bool drained = false;
  const auto width = static_cast<std::size_t>(field.width);
  const int x = static_cast<int>(pixel % width), z = static_cast<int>(pixel / width);
  const float height = field.heights[pixel];
  for (const FlowStep step : kFlowSteps) {
    const int i = x + step.x, j = z + step.z;
    if (i < 0 || j < 0 || i >= field.width || j >= field.depth) {
      drained = true;
      continue;
    }
    const float there = field.at(i, j);
    // True for no-data too.
    if (!(there >= height)) drained = true;
    const std::size_t at = static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
    if (there == height && seen[at] == 0) {
      seen[at] = 1;
      flat.push_back(at);
    }
  }
  return drained;
}

}  // namespace

std::size_t count_pits(const Heightfield& field) {
  std::vector<std::uint8_t> seen(field.heights.size());
  std::vector<std::size_t> flat;
  std::size_t pits = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start] != 0 || Heightfield::is_no_data(field.heights[start])) continue;
    flat.assign(1, start);
    seen[start] = 1;
    bool drained = false;
    for (std::size_t next = 0; next < flat.size(); ++next) drained |= drains(field, flat[next], seen, flat);
    pits += !drained;
  }
  return pits;
}

}  // namespace terrabench
