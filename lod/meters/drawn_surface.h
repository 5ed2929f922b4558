// The height of the drawn surface at any point, for collisions with what is seen: an index of the frame's
// triangles by square tiles of samples. Building: O(triangles + tiles they touch); a query: O(triangles that
// touch the point's tile).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/plan_triangle.h"
#include "terrain/frame.h"
#include "terrain/heightfield.h"

namespace terrabench {

class DrawnSurface {
 public:
  // For a frame over terrain of width × depth samples; parts of it that lie outside are left out.
  DrawnSurface(const Frame&, int width, int depth);

  // The height over (x, z), in samples: 0 to width - 1 and 0 to depth - 1. Triangles include their edges;
  // where several lie over the point, the highest counts, which is the one that is seen. NaN where nothing is
  // drawn. Triangles without plan area (skirts) and clockwise ones draw nothing.
  float height(double x, double z) const;

  std::size_t bytes() const;  // heap
  std::size_t triangles() const { return corners_.size() / 3; }

 private:
  static constexpr int kTile = 8;  // samples along its side
  struct Tiles {
    int x0, x1, z0, z1;  // both ends included
  };
  Tiles tiles_of(const Corner* triangle) const;

  int across_, down_;                   // tiles
  std::vector<Corner> corners_;         // three per triangle
  std::vector<std::uint32_t> begins_;   // per tile, in members_; one more at the end
  std::vector<std::uint32_t> members_;  // triangles, tile by tile
};

// The height of the full terrain over (x, z), in samples: on its two triangles per cell, split from low x,
// high z to high x, low z, as the full-resolution mesh is. The point must lie on the ground. O(1)
double height_on_cells(const Heightfield&, double x, double z);

}  // namespace terrabench
