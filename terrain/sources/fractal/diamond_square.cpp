#include "terrain/sources/fractal/diamond_square.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/fractal/diamond_square_rows.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

constexpr char kWhere[] = "diamond-square";
constexpr int kLargestLevels = 15;

// Rows are circular: the last row equals the first.
int around(int row, int period) { return (row % period + period) % period; }

// The first and the number of the coarse rows that so many fine rows stand on or between, and one more on
// both sides.
std::pair<int, int> coarse_rows(int first, int rows) {
  const int low = (first >> 1) - 1;
  return {low, ((first + rows - 1) >> 1) + 2 - low};
}

// One level: a diamond and a square step, from the grid of 2^level + 1 samples per side to some rows of the
// next. Grids are stored whole, row after row: far faster than the textbook's steps within the final array,
// which touch each of its cache lines once per level. coarse(r) is row r, circular, of coarse_rows().
template <class CoarseRow>
void expand(const DiamondSquareOptions& options, int level, const CoarseRow& coarse, int first, int rows,
            float* out) {
  const int points = (1 << level) + 1, period = 2 << level;
  const float range = level_range(options.amplitude, options.hurst, level);
  // Of one fine row; opposite borders have one key.
  const auto displacement_of = [&](int row) {
    const auto which =
        static_cast<std::uint64_t>(level) << 32 | static_cast<std::uint32_t>(around(row, period));
    return RowDisplacement{row_key(options.seed, kDiamondSquare, which), range};
  };
  // Middles between a coarse row and the next, with the last one repeated before the first.
  std::vector<float> above(static_cast<std::size_t>(points)), below(above.size());
  const auto middles = [&](int row, std::vector<float>& into) {
    diamond_row(coarse(row), coarse(row + 1), points, displacement_of(2 * row + 1), into.data() + 1);
    into[0] = into.back();
  };
  int made = coarse_rows(first, rows).first;
  middles(made, below);  // `below` holds those after this coarse row, `above` those before it
  for (int row = first; row < first + rows; ++row, out += period + 1) {
    const int r = row >> 1;
    for (; made < r; ++made) {
      std::swap(above, below);
      middles(made + 1, below);
    }
    if (row % 2 == 0) {
      even_row(coarse(r), above.data() + 1, below.data() + 1, points, displacement_of(row), out);
    } else {
      odd_row(coarse(r), coarse(r + 1), below.data() + 1, points, displacement_of(row), out);
    }
  }
}

void check(const DiamondSquareOptions& options) {
  check_between(options.cell, 1e-6, kLargestMetres, "cell", kWhere);
  check_between(options.corner, -kLargestMetres, kLargestMetres, "corner", kWhere);
  check_between(options.amplitude, 0, kLargestMetres, "amplitude", kWhere);
  check_between(options.hurst, 0, 1, "hurst", kWhere);
  levels_of_side(options.side);
}

DiamondSquareOptions reduced(DiamondSquareOptions options, int levels) {
  check_between(levels, 1, levels_of_side(options.side), "kept", kWhere);
  options.side = (1 << levels) + 1;
  return options;
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
  check_memory(options.side, options.side + options.side / 4, kWhere);
  std::vector<float> grid(4, options.corner);
  for (int level = 0; level < levels_of_side(options.side); ++level) {
    const int points = (1 << level) + 1, side = (2 << level) + 1;
    std::vector<float> fine(static_cast<std::size_t>(side) * side);
    const auto coarse = [&](int row) {
      return &grid[static_cast<std::size_t>(around(row, points - 1)) * points];
    };
    constexpr int kBand = 64;  // rows per task; neighbouring tasks both compute a row of middles
    tbb::parallel_for(
        tbb::blocked_range<int>(0, side, kBand),
        [&](const tbb::blocked_range<int>& band) {
          expand(options, level, coarse, band.begin(), static_cast<int>(band.size()),
                 &fine[static_cast<std::size_t>(band.begin()) * side]);
        },
        tbb::simple_partitioner());
    grid = std::move(fine);
  }
  return {options.side, options.side, options.cell, options.cell, std::move(grid), {}};
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

DiamondSquareBands::DiamondSquareBands(const DiamondSquareOptions& options, int kept)
    : options_(options),
      kept_(std::min(kept, levels_of_side(options.side))),
      coarse_(diamond_square(reduced(options, kept_))) {}

void DiamondSquareBands::read(int first, int rows, std::span<float> out) const {
  assert(first >= 0 && rows >= 0 && first + rows <= side());
  assert(out.size() == static_cast<std::size_t>(rows) * side());
  read_level(levels_of_side(options_.side), first, rows, out.data());
}

void DiamondSquareBands::read_level(int level, int first, int rows, float* out) const {
  const int period = 1 << level;
  const auto width = static_cast<std::size_t>(period) + 1;
  if (level == kept_) {
    for (int k = 0; k < rows; ++k, out += width) {
      std::copy_n(&coarse_.heights[static_cast<std::size_t>(around(first + k, period)) * width], width, out);
    }
    return;
  }
  const auto [low, count] = coarse_rows(first, rows);
  const auto points = static_cast<std::size_t>(period / 2 + 1);
  std::vector<float> grid(static_cast<std::size_t>(count) * points);
  read_level(level - 1, low, count, grid.data());
  const auto coarse = [&, low = low](int row) { return &grid[static_cast<std::size_t>(row - low) * points]; };
  expand(options_, level - 1, coarse, first, rows, out);
}

}  // namespace terrabench::fractal
