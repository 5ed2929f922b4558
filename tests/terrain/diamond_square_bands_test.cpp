// Bands hold the very bits of the whole terrain, wherever they begin.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "terrain/error.h"
#include "terrain/sources/fractal/diamond_square.h"

namespace terrabench::fractal {
namespace {

TEST(DiamondSquareBands, AreRowsOfTheWhole) {
  for (const int levels : {1, 2, 5, 8}) {
    const DiamondSquareOptions options{.seed = 7, .side = (1 << levels) + 1};
    const Heightfield whole = diamond_square(options);
    for (int kept = 1; kept <= levels + 2; ++kept) {
      const DiamondSquareBands bands(options, kept);
      std::mt19937 random(3);
      for (int k = 0; k < 40; ++k) {
        const int first = k == 0 ? 0 : static_cast<int>(random() % options.side);
        const int rows =
            k < 2 ? options.side - first : static_cast<int>(random() % (options.side - first + 1));
        std::vector<float> band(static_cast<std::size_t>(rows) * options.side);
        bands.read(first, rows, band);
        const auto expected = whole.heights.begin() + static_cast<std::ptrdiff_t>(first) * options.side;
        ASSERT_TRUE(std::equal(band.begin(), band.end(), expected))
            << first << '+' << rows << ", kept " << kept;
      }
    }
  }
}

TEST(DiamondSquareBands, RefuseWhatTheWholeRefuses) {
  EXPECT_THROW(DiamondSquareBands({.side = 100}), Error);
  EXPECT_THROW(DiamondSquareBands({.side = 129}, 0), Error);
}

}  // namespace
}  // namespace terrabench::fractal
