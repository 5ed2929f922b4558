// Where a clipmap takes its heights from: a field in memory, or a pyramid of tiles on disk that never comes
// into memory whole.
#pragma once

#include <memory>
#include <span>

#include "terrain/heightfield.h"
#include "terrain/sources/dem/height_pyramid.h"

namespace terrabench {

// The terrain's samples as levels: lattice sample (a, b) of level l is sample (a·2ˡ, b·2ˡ) of the terrain,
// taken as it is, so that levels agree to the bit where they meet; outside the terrain it is the sample of
// the border.
class HeightSource {
 public:
  virtual ~HeightSource() = default;
  virtual int width() const = 0;
  virtual int depth() const = 0;
  virtual float cell_x() const = 0;
  virtual float cell_z() const = 0;
  // Lattice samples [a, a + columns) × [b, b + rows), row by row, into `out`, whose rows are `stride` apart.
  virtual void read(int level, int a, int b, int columns, int rows, float* out, int stride) = 0;
  virtual std::size_t bytes() const = 0;  // heap bytes held, itself included
};

// The field must outlive it.
std::unique_ptr<HeightSource> heights_in_memory(const Heightfield&);
std::unique_ptr<HeightSource> heights_on_disk(std::unique_ptr<HeightPyramid>);

}  // namespace terrabench
