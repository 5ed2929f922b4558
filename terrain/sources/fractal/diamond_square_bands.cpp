#include "terrain/sources/fractal/diamond_square_bands.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "terrain/sources/fractal/diamond_square_rows.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

// Rows are circular: the last row equals the first.
int around(int row, int period) { return (row % period + period) % period; }

DiamondSquareOptions reduced(DiamondSquareOptions options, int levels) {
  check_between(levels, 1, levels_of_side(options.side), "kept", "diamond-square");
  options.side = (1 << levels) + 1;
  return options;
}

}  // namespace

DiamondSquareBands::DiamondSquareBands(const DiamondSquareOptions& options, int kept)
    : options_(options),
      kept_(std::min(kept, levels_of_side(options.side))),
      levels_(levels_of_side(options.side)),
      coarse_(diamond_square(reduced(options, kept_))) {}

void DiamondSquareBands::read(int first, int rows, std::span<float> out) const {
  assert(first >= 0 && rows >= 0 && first + rows <= side());
  assert(out.size() == static_cast<std::size_t>(rows) * side());
  expand(levels_, first, rows, out.data());
}

// Rows of the grid of 2^level + 1 samples, from those of the grid before it that they stand on or between.
void DiamondSquareBands::expand(int level, int first, int rows, float* out) const {
  const int period = 1 << level, side = period + 1;
  if (level == kept_) {
    for (int k = 0; k < rows; ++k) {
      std::copy_n(&coarse_.heights[static_cast<std::size_t>(around(first + k, period)) * side], side,
                  out + static_cast<std::size_t>(k) * side);
    }
    return;
  }
  const int points = period / 2 + 1;
  const int low = (first >> 1) - 1, count = ((first + rows - 1) >> 1) + 2 - low;
  const auto width = static_cast<std::size_t>(points);
  std::vector<float> grid(count * width);
  expand(level - 1, low, count, grid.data());
  const float range = level_range(options_.amplitude, options_.hurst, level - 1);
  const auto displacement_of = [&](int row) {
    const auto which =
        static_cast<std::uint64_t>(level - 1) << 32 | static_cast<std::uint32_t>(around(row, period));
    return RowDisplacement{row_key(options_.seed, kDiamondSquare, which), range};
  };
  const auto coarse = [&](int row) { return &grid[(row - low) * width]; };
  // Middles between a coarse row and the next, with the last one repeated before the first.
  std::vector<float> above(width), below(width);
  const auto middles = [&](int row, std::vector<float>& into) {
    diamond_row(coarse(row), coarse(row + 1), points, displacement_of(2 * row + 1), into.data() + 1);
    into[0] = into[width - 1];
  };
  middles(low, below);
  int made = low;  // `below` holds those after this coarse row, `above` those before it
  for (int row = first; row < first + rows; ++row, out += side) {
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

}  // namespace terrabench::fractal
