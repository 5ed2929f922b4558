// The triangles into which the GPU's tessellator divides a square patch, as indices: a grid of n × n segments
// whose outermost ring of cells is replaced by four strips, each between a side's own segments and the n - 2
// segments of the inner square beside it.
//
// OpenGL fixes the vertices and these five regions (specification 4.5, §11.2.2.2), but neither the diagonals
// of the inner cells nor the triangles of the strips. Here they are those of Direct3D 11's tessellator, which
// Mesa follows: diagonals point to the patch's middle, and a strip's rows of segments advance from both ends
// towards the middle in the order of their halves' fractions, the inner row first. With n = 2 there is no
// choice: all segments meet in the middle. OpenGL leaves the diagonal open where nothing is divided, so n is
// at least 2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/geomipmap/patch_grid.h"
#include "lod/plan_triangle.h"
#include "terrain/frame.h"
#include "terrain/memory.h"

namespace terrabench::tessellated {

inline constexpr int kInside = 4;  // place after the sides in TessellatedPatch::factors

// The logarithm of the segments of a side or of the inside.
inline int factor_log(std::uint32_t factors, int place) {
  return static_cast<int>(factors >> (4 * place) & 0xFU);
}

// For all patches of a grid; whole ones and those that the ground's border cuts have patterns of their own,
// without the triangles of no area that a tessellator makes beyond the border. O(side² + side · log² side)
// indices.
class PatchTriangles {
 public:
  explicit PatchTriangles(const PatchGrid&);

  int logs() const { return logs_; }  // the largest logarithm, of one segment per cell
  // The inner square; `shape`: PatchGrid::shape(), `inside` ≥ 1.
  IndexRange inner(int shape, int inside) const { return pattern(shape, inside, 0); }
  IndexRange strip(int shape, int inside, int side, int outside) const {
    return pattern(shape, inside, 1 + side * (logs_ + 1) + outside);
  }
  // Vertices of the ground, relative to the patch's low corner.
  std::span<const std::uint32_t> indices() const { return indices_; }
  // Appends the patch's triangles; a batch's level is 0 at one segment per cell.
  void append(const TessellatedPatch&, int shape, std::vector<Batch>&) const;
  Memory memory() const;

 private:
  // A point in a patch that is not cut, in cells.
  struct Point {
    int x, z;
  };
  const IndexRange& pattern(int shape, int inside, int part) const {
    return patterns_[static_cast<std::size_t>((shape * logs_ + inside - 1) * parts_ + part)];
  }
  void add_shape(const PatchGrid::Patch&, int shape);
  void add_inner(const PatchGrid::Patch&, int inside);
  void add_strip(const PatchGrid::Patch&, int inside, int side, int outside);
  void add(const PatchGrid::Patch&, const Point& a, const Point& b, const Point& c);

  int side_, width_, logs_, parts_;
  std::vector<IndexRange> patterns_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace terrabench::tessellated
