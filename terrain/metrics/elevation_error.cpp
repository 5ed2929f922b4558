#include "terrain/metrics/elevation_error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "terrain/error.h"

namespace terrabench {
namespace {

struct RowError {
  double squares = 0, largest = 0;
  std::size_t pixels = 0, unmatched = 0;
};

RowError compare_row(const float* a, const float* b, int width) {
  RowError row;
  for (int i = 0; i < width; ++i) {
    const bool in_a = !Heightfield::is_no_data(a[i]), in_b = !Heightfield::is_no_data(b[i]);
    row.unmatched += in_a != in_b;
    if (!in_a || !in_b) continue;
    const double error = static_cast<double>(b[i]) - a[i];
    row.squares += error * error;
    row.largest = std::max(row.largest, std::abs(error));
    ++row.pixels;
  }
  return row;
}

}  // namespace

double ElevationError::normalised() const {
  if (rmse == 0) return 0;
  return range > 0 ? rmse / range : std::numeric_limits<double>::infinity();
}

ElevationError elevation_error(const Heightfield& original, const Heightfield& other) {
  if (original.width != other.width || original.depth != other.depth) {
    throw usage_error(fmt::format("terrains of {}×{} and {}×{} samples cannot be compared", original.width,
                                  original.depth, other.width, other.depth),
                      "", "resample one to the size of the other");
  }
  std::vector<RowError> rows(static_cast<std::size_t>(original.depth));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t j) {
    const std::size_t first = j * original.width;
    rows[j] = compare_row(original.heights.data() + first, other.heights.data() + first, original.width);
  });
  ElevationError result;
  double squares = 0;
  for (const RowError& row : rows) {
    squares += row.squares;
    result.largest = std::max(result.largest, row.largest);
    result.pixels += row.pixels;
    result.unmatched += row.unmatched;
  }
  if (result.pixels > 0) result.rmse = std::sqrt(squares / static_cast<double>(result.pixels));
  const HeightRange range = height_range(original);
  if (range.highest >= range.lowest) result.range = static_cast<double>(range.highest) - range.lowest;
  return result;
}

}  // namespace terrabench
