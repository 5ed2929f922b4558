#include "lod/mrbsp/height_points.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "lod/lod.h"
#include "lod/mrbsp/nearest_three.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {

std::vector<glm::vec3> height_points(const Heightfield& field) {
  require_memory(field.heights.size() * (sizeof(glm::vec3) + NearestThree::kBytesPerPoint), "height points");
  std::vector<glm::vec3> points(field.heights.size());
  tbb::parallel_for(0, field.depth, [&](int j) {
    for (int i = 0; i < field.width; ++i) {
      points[static_cast<std::size_t>(j) * field.width + i] = {
          static_cast<float>(i) * field.cell_x, field.at(i, j), static_cast<float>(j) * field.cell_z};
    }
  });
  return points;
}

Heightfield interpolate_heights(std::span<const glm::vec3> points, const BisectionTree& tree,
                                Progress& progress) {
  const PlanExtent extent = plan_extent(points);
  const glm::vec2 size = extent.high - extent.low;
  if (!(size.x > 0 && size.y > 0)) {
    throw usage_error("the height points lie in one line", "", "give points that span an area");
  }
  const std::uint64_t along = static_cast<std::uint64_t>(tree.side()) + 1;
  require_memory(along * along * sizeof(float) + points.size() * NearestThree::kBytesPerPoint,
                 fmt::format("a grid of {}² heights", along), "choose a smaller depth");
  const NearestThree nearest(points);
  Heightfield field;
  field.width = field.depth = tree.side() + 1;
  field.cell_x = size.x / static_cast<float>(tree.side());
  field.cell_z = size.y / static_cast<float>(tree.side());
  field.heights.resize(static_cast<std::size_t>(field.width) * field.width);
  progress.begin("interpolating heights", static_cast<std::uint64_t>(field.depth));
  tbb::parallel_for(0, field.depth, [&](int j) {
    // The last row and column lie exactly on the border, where there may be a point.
    const float z = j == tree.side() ? extent.high.y : extent.low.y + static_cast<float>(j) * field.cell_z;
    for (int i = 0; i < field.width; ++i) {
      const float x = i == tree.side() ? extent.high.x : extent.low.x + static_cast<float>(i) * field.cell_x;
      field.at(i, j) = nearest.height(x, z);
    }
    progress.advance();
  });
  progress.end();
  return field;
}

}  // namespace terrabench
