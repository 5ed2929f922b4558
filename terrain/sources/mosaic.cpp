#include "terrain/sources/mosaic.h"

#include <algorithm>

namespace terrabench {
namespace {

// The tile's sample at a place that counts from its first one: … 1 0 1 2 1 0 … for a tile of three. Its
// border is not doubled.
int mirrored(int i, int samples) {
  const int last = std::max(samples - 1, 1), period = 2 * last, k = (i % period + period) % period;
  return std::min(k, period - k) % samples;
}

}  // namespace

Heightfield mirrored_mosaic(const Heightfield& tile, int size) {
  Heightfield mosaic = Heightfield::zeros(size, size, tile.cell_x, tile.cell_z);
  const int west = (size - tile.width) / 2, north = (size - tile.depth) / 2;  // of the tile in the middle
  for (int j = 0; j < size; ++j) {
    const int row = mirrored(j - north, tile.depth);
    for (int i = 0; i < size; ++i) mosaic.at(i, j) = tile.at(mirrored(i - west, tile.width), row);
  }
  return mosaic;
}

}  // namespace terrabench
