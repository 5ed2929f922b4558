#include "terrain/metrics/distance_transform.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace terrabench {
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
