// What can be seen from where, found once before the walk (MRBSP paper, §4). The ground is divided into
// rectangular cells in plan; for each, the coarse triangles that an observer standing anywhere in it can see.
// Stored as changes between neighbouring cells (visibility_table.h), applied to flags of the nodes
// (visible_flags.h). Coarse triangles are those of one odd depth of the tree, so
// that they are the halves of squares; what they hide or show, their subtrees do.
//
// Two ways to find the sets:
// - sampled: from eyes in the cell to the corners of coarse triangles, with the coarse surface in the way.
//   Ground that the coarse surface lacks can be missed. To the printed rule this adds that
//   - an eye stands above the fine ground, and above the coarse one where that is higher;
//   - a triangle counts only when it faces the eye that sees one of its corners: neighbours share corners, so
//     that the paper's own table 1 cannot come from corners alone;
//   - a triangle that the cell stands on always counts.
// - conservative: never misses, for the full surface and every eye on it or up to the eye height above, but
//   not for one beneath, which the ground in between does not stop (Mrbsp::on_the_ground()). Whole cells are
//   tested against whole blocks of ground: hidden when, on some grid line between the two, the lowest ground
//   along all of the stretch that the lines of sight cross stands above the highest of these lines. Both are
//   quartered where that fails. For the sight line's height only the highest eye in the cell and the highest
//   ground in the block count: a lower one sees, or shows, no more.
//
// Cost: cells × blocks × lines between them, in parallel over cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"
#include "terrain/progress.h"

namespace terrabench {

// The deepest level that coarse triangles may be taken from.
inline constexpr int kDeepestCoarse = 24;

struct VisibilityOptions {
  bool conservative = true;
  int cells = 16;           // at most so many along the longer side
  int coarseness = 6;       // coarse triangles lie at least so many levels above the finest
  int eyes = 2;             // sampled: along each side of a cell, in the middles of equal parts
  float eye_height = 1.8F;  // metres above the ground
};

// Cells are squares of `side` samples, a power of two; the last ones end at the field's border.
struct CellGrid {
  int columns = 1, rows = 1, side = 1;
  int count() const { return columns * rows; }
  bool operator==(const CellGrid&) const = default;
};

// Names what sets hold for, as 32 hex digits: the samples, their distances, and the tree over them.
using SurfaceChecksum = std::array<char, 32>;
SurfaceChecksum surface_checksum(const GroundGrid&, const BisectionTree&);

// A bit a cell and coarse triangle: element e of depth C is node 2^C + e.
struct VisibleSets {
  CellGrid cells;
  int depth = 1;          // C
  std::size_t words = 1;  // a cell
  float eye_height = 0;   // metres
  SurfaceChecksum surface{};
  bool conservative = false;
  std::vector<std::uint64_t> bits;

  VisibleSets() = default;
  VisibleSets(CellGrid cells, int depth, float eye_height);
  bool sees(int cell, std::uint32_t element) const {
    return ((bits[cell * words + element / 64] >> (element % 64)) & 1) != 0;
  }
  void add(int cell, std::uint32_t element) {
    bits[cell * words + element / 64] |= std::uint64_t{1} << (element % 64);
  }
  std::size_t count(int cell) const;
  bool operator==(const VisibleSets&) const = default;
};

// What the options make of cells and of coarse triangles' depth. Throws usage_error for options out of range.
struct VisibilityHead {
  CellGrid cells;
  int depth = 1;
};
VisibilityHead visibility_head(const GroundGrid&, const BisectionTree&, const VisibilityOptions&);

// Throws usage_error for options out of range or sets beyond 512 MiB. The same for any number of threads.
VisibleSets find_visible(const GroundGrid&, const BisectionTree&, const VisibilityOptions&, Progress&);

}  // namespace terrabench
