#include "terrain/sources/fractal/diamond_square.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/fractal/diamond_square_rows.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

constexpr char kWhere[] = "diamond-square";
constexpr int kLargestLevels = 15;

// One level: a diamond and a square step from a grid of `points` on a side, stored row after row, to one of
// 2·points − 1. Far faster than the textbook's steps within the final array, which touch each of its cache
// lines once per level.
class Subdivision {
 public:
  Subdivision(const DiamondSquareOptions& options, int level)
      : seed_(options.seed), level_(level), points_((1 << level) + 1) {
    range_ = level_range(options.amplitude, options.hurst, level);
  }

  int points() const { return points_; }
  int fine_side() const { return 2 * points_ - 1; }
  std::size_t coarse_size() const { return static_cast<std::size_t>(points_) * points_; }
  std::size_t fine_size() const { return static_cast<std::size_t>(fine_side()) * fine_side(); }

  // Fine rows 2·begin … 2·end − 1, with end < points. `coarse` holds the rows from `first` on, up to the
  // last; rows 0 and points − 2 must be among them when begin is 0. Fine rows go to `fine`, where row 0 would
  // start.
  void expand(const float* coarse, int first, int begin, int end, float* fine) const {
    constexpr int kBand =
        32;  // rows per task; neighbouring tasks both compute the row of middles between them
    tbb::parallel_for(
        tbb::blocked_range<int>(begin, end, kBand),
        [&](const tbb::blocked_range<int>& band) {
          expand_band(coarse, first, band.begin(), band.end(), fine);
        },
        tbb::simple_partitioner());
  }

 private:
  // Displacements of one fine row; opposite borders have one key.
  RowDisplacement displacement_of(int fine_row) const {
    const auto row = static_cast<std::uint64_t>(level_) << 32 | static_cast<std::uint32_t>(fine_row);
    return {row_key(seed_, kDiamondSquare, row), range_};
  }

  void expand_band(const float* coarse, int first, int begin, int end, float* fine) const {
    const auto width = static_cast<std::size_t>(points_);
    const auto row = [&](int r) { return coarse + static_cast<std::size_t>(r - first) * width; };
    const auto fine_row = [&](int z) { return fine + static_cast<std::size_t>(z) * fine_side(); };
    // One value before each row of middles: the array is circular.
    std::vector<float> above(width), below(width);
    const auto middles = [&](int r, std::vector<float>& out) {
      diamond_row(row(r), row(r + 1), points_, displacement_of(2 * r + 1), out.data() + 1);
      out[0] = out[width - 1];
    };
    middles(begin > 0 ? begin - 1 : points_ - 2, above);
    for (int r = begin; r < end; ++r) {
      middles(r, below);
      even_row(row(r), above.data() + 1, below.data() + 1, points_, displacement_of(2 * r), fine_row(2 * r));
      odd_row(row(r), row(r + 1), below.data() + 1, points_, displacement_of(2 * r + 1), fine_row(2 * r + 1));
      std::swap(above, below);
    }
  }

  std::uint64_t seed_;
  int level_, points_;
  float range_ = 0;
};

// The last level fills the array whose tail holds that level's input. Fine rows grow four times as fast as
// coarse rows are used up, so the first three quarters can be written at once, then three quarters of the
// rest, and so on; the last few rows are made from a copy.
void expand_in_place(const Subdivision& level, float* heights) {
  const int points = level.points();
  const auto width = static_cast<std::size_t>(points),
             fine_side = static_cast<std::size_t>(level.fine_side());
  const std::size_t tail = level.fine_size() - level.coarse_size();
  const float* const coarse = heights + tail;
  for (int begin = 0; begin < points - 1;) {
    const int first = std::max(0, begin - 1);  // the lowest coarse row that is still needed
    const std::size_t writable = tail + static_cast<std::size_t>(first) * width;
    const int end = std::min(points - 1, static_cast<int>(writable / fine_side / 2));
    constexpr int kFew = 8;
    if (end - begin >= kFew) {
      level.expand(coarse, 0, begin, end, heights);
      begin = end;
    } else {
      const std::vector<float> rest(coarse + static_cast<std::size_t>(first) * width,
                                    coarse + level.coarse_size());
      level.expand(rest.data(), first, begin, points - 1, heights);
      begin = points - 1;
    }
  }
}

// The grids of successive levels lie at alternate ends of the array, so that the last level's input lies at
// its tail.
void run(const DiamondSquareOptions& options, int levels, float* heights, std::size_t size) {
  const auto place = [&](int level) {  // where the input of this level starts
    const auto points = (std::size_t{1} << level) + 1;
    return (levels - 1 - level) % 2 == 0 ? heights + size - points * points : heights;
  };
  std::fill_n(place(0), 4, options.corner);
  for (int l = 0; l < levels; ++l) {
    const Subdivision level(options, l);
    float* const fine = l + 1 == levels ? heights : place(l + 1);
    if (l + 1 == levels) {
      expand_in_place(level, heights);
    } else {
      level.expand(place(l), 0, 0, level.points() - 1, fine);
    }
    const auto side = static_cast<std::size_t>(level.fine_side());
    std::memcpy(fine + side * (side - 1), fine, side * sizeof(float));
  }
}

void check(const DiamondSquareOptions& options) {
  check_between(options.cell, 1e-6, kLargestMetres, "cell", kWhere);
  check_between(options.corner, -kLargestMetres, kLargestMetres, "corner", kWhere);
  check_between(options.amplitude, 0, kLargestMetres, "amplitude", kWhere);
  check_between(options.hurst, 0, 1, "hurst", kWhere);
  levels_of_side(options.side);
  check_memory(options.side, options.side, kWhere);
}

}  // namespace

int levels_of_side(int side) {
  for (int n = 1; n <= kLargestLevels; ++n) {
    if (side == (1 << n) + 1) return n;
  }
  throw usage_error(fmt::format("side must be 2^n + 1 samples, n between 1 and 15, got {}", side), kWhere,
                    "such as 513, 1025 or 4097");
}

Heightfield diamond_square(const DiamondSquareOptions& options) {
  check(options);
  Heightfield field = Heightfield::zeros(options.side, options.side, options.cell, options.cell);
  run(options, levels_of_side(options.side), field.heights.data(), field.heights.size());
  return field;
}

Heightfield diamond_square_after(const DiamondSquareOptions& options, int steps) {
  check(options);
  const int levels = levels_of_side(options.side);
  check_between(steps, 0, 2 * levels, "steps", kWhere);
  Heightfield field = diamond_square(options);
  // After an odd number of steps the last level has its middles only.
  const int reached = (steps + 1) / 2, apart = (options.side - 1) >> reached;
  const bool only_middles = steps % 2 == 1;
  for (int z = 0; z < options.side; ++z) {
    for (int x = 0; x < options.side; ++x) {
      const bool on_grid = x % apart == 0 && z % apart == 0;
      const bool by_square_step = (x / apart + z / apart) % 2 == 1;
      if (!on_grid || (only_middles && by_square_step)) field.at(x, z) = Heightfield::kNoData;
    }
  }
  return field;
}

}  // namespace terrabench::fractal
