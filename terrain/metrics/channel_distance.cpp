#include "terrain/metrics/channel_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

#include "terrain/metrics/distance_transform.h"
#include "terrain/metrics/nearest_point.h"

namespace terrabench {
namespace {

using Way = ChannelDistance::Way;

// Sums over parts of fixed size, added in order: the same for any number of threads.
template <class DistanceOf>
Way summarise(std::span<const std::uint32_t> pixels, const DistanceOf& distance) {
  constexpr std::size_t kPart = 1024;
  std::vector<Way> parts((pixels.size() + kPart - 1) / kPart);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    const std::size_t end = std::min(pixels.size(), (part + 1) * kPart);
    for (std::size_t i = part * kPart; i < end; ++i) {
      const double at = distance(pixels[i]);
      parts[part].sum += at;
      parts[part].largest = std::max(parts[part].largest, at);
    }
  });
  Way all;
  for (const Way& part : parts) {
    all.sum += part.sum;
    all.largest = std::max(all.largest, part.largest);
  }
  all.mean = pixels.empty() ? 0 : all.sum / static_cast<double>(pixels.size());
  return all;
}

Way in_plane(const Heightfield& field, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
             double cell_x, double cell_z) {
  const auto squared = squared_distances(field.width, field.depth, cell_x, cell_z, to);
  return summarise(from, [&](std::uint32_t pixel) { return std::sqrt(squared[pixel]); });
}

SpacePoint point_of(const Heightfield& field, std::uint32_t pixel, double cell_x, double cell_z) {
  const auto width = static_cast<std::uint32_t>(field.width);
  return {pixel % width * cell_x, field.heights[pixel], pixel / width * cell_z};
}

Way in_space(const Heightfield& field, std::span<const std::uint32_t> from, const Heightfield& other,
             std::span<const std::uint32_t> to, double cell_x, double cell_z) {
  std::vector<SpacePoint> points(to.size());
  for (std::size_t i = 0; i < to.size(); ++i) points[i] = point_of(other, to[i], cell_x, cell_z);
  const NearestPoint nearest(std::move(points));
  return summarise(from, [&](std::uint32_t pixel) {
    return std::sqrt(nearest.squared_distance(point_of(field, pixel, cell_x, cell_z)));
  });
}

}  // namespace

double ChannelDistance::normalised(ChannelAverage average) const {
  const double distance = hausdorff(average);
  if (distance == 0) return 0;
  return corners > 0 ? distance / corners : std::numeric_limits<double>::infinity();
}

ChannelDistance channel_distance(const Heightfield& original, std::span<const std::uint32_t> channels,
                                 const Heightfield& other, std::span<const std::uint32_t> other_channels,
                                 ChannelSpace space) {
  assert(original.width == other.width && original.depth == other.depth);
  const bool plane = space == ChannelSpace::kPlane || space == ChannelSpace::kPlaneSamples;
  const bool samples = space == ChannelSpace::kPlaneSamples || space == ChannelSpace::kSpaceSamples;
  const double cell_x = samples ? 1 : original.cell_x, cell_z = samples ? 1 : original.cell_z;
  ChannelDistance result;
  result.corners = std::hypot((original.width - 1) * cell_x, (original.depth - 1) * cell_z);
  if (channels.empty() != other_channels.empty()) {
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    result.from_original = result.from_other = {kInfinite, kInfinite, kInfinite};
  } else if (plane) {
    result.from_original = in_plane(original, channels, other_channels, cell_x, cell_z);
    result.from_other = in_plane(original, other_channels, channels, cell_x, cell_z);
  } else {
    result.from_original = in_space(original, channels, other, other_channels, cell_x, cell_z);
    result.from_other = in_space(other, other_channels, original, channels, cell_x, cell_z);
  }
  return result;
}

}  // namespace terrabench
