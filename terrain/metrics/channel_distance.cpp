#include "terrain/metrics/channel_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

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

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Replaces infinity and 0 by the squared distance along each column: from the last point met, once downwards
// and once upwards. Bands of columns, so that whole cache lines are used.
void column_pass(int width, int depth, double cell_z, std::vector<double>& squared) {
  tbb::parallel_for(tbb::blocked_range<int>(0, width, 64), [&](const tbb::blocked_range<int>& columns) {
    std::vector<double> since(columns.size());
    const auto sweep = [&](int j) {
      double* const row = squared.data() + static_cast<std::size_t>(j) * width + columns.begin();
      for (std::size_t i = 0; i < since.size(); ++i) {
        since[i] = row[i] == 0 ? 0 : since[i] + 1;
        const double distance = since[i] * cell_z;
        row[i] = std::min(row[i], distance * distance);
      }
    };
    std::fill(since.begin(), since.end(), kInfinity);
    for (int j = 0; j < depth; ++j) sweep(j);
    std::fill(since.begin(), since.end(), kInfinity);
    for (int j = depth; j-- > 0;) sweep(j);
  });
}

// The lower envelope of the parabolas over one row: the nearest columns, and where each begins to be the
// nearest. Reused between rows.
class Envelope {
 public:
  explicit Envelope(int width) : column_(width), from_(width), height_(width) {}

  void transform(double* row, int width, double cell_x) {
    const double area = cell_x * cell_x;
    int count = 0;
    for (int i = 0; i < width; ++i) {
      if (row[i] == kInfinity) continue;
      double from = -kInfinity;
      while (count > 0) {
        const int last = column_[count - 1];
        // Where the new parabola passes under the last one.
        from = 0.5 * ((row[i] - height_[count - 1]) / (area * (i - last)) + i + last);
        if (from > from_[count - 1]) break;
        --count;
        from = -kInfinity;
      }
      column_[count] = i;
      height_[count] = row[i];
      from_[count] = from;
      ++count;
    }
    for (int i = 0, k = 0; i < width && count > 0; ++i) {
      while (k + 1 < count && from_[k + 1] <= i) ++k;
      const double across = i - column_[k];
      row[i] = across * across * area + height_[k];
    }
  }

 private:
  std::vector<int> column_;
  std::vector<double> from_, height_;
};

}  // namespace

std::vector<double> squared_distances(int width, int depth, double cell_x, double cell_z,
                                      std::span<const std::uint32_t> points) {
  std::vector<double> squared(static_cast<std::size_t>(width) * depth, kInfinity);
  for (const std::uint32_t point : points) squared[point] = 0;
  column_pass(width, depth, cell_z, squared);
  tbb::parallel_for(tbb::blocked_range<int>(0, depth, 16), [&](const tbb::blocked_range<int>& rows) {
    Envelope envelope(width);
    for (int j = rows.begin(); j < rows.end(); ++j) {
      envelope.transform(squared.data() + static_cast<std::size_t>(j) * width, width, cell_x);
    }
  });
  return squared;
}

}  // namespace terrabench
