// The triangle pattern of a clipmap window (Losasso & Hoppe 2004, §3.1 and §3.4; Asirvatham & Hoppe 2005): n
// × n vertices, n = 4m - 1, cut into blocks for culling, with variants for the hole in which the next finer
// window lies. One index array serves all levels. O(n²) to make.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "terrain/frame.h"

namespace terrabench::clipmap {

// Cells [x0, x1) × [z0, z1) of the window, row by row. Vertex (a, b) is b·side + a.
struct Block {
  IndexRange indices;
  int x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  std::uint32_t first_row = 0;  // in WindowPattern::rows
};

// The blocks of ring (r) and middle (m), by index, and where they meet:
//
//          0    m-1    2m    3m-1  4m-2
//        0 +-----+-----+-----+-----+
//          | r0  | r1  | r2  | r3  |
//      m-1 +-----+-----+-----+-----+
//          | r4  | m0  | m1  | r5  |
//       2m +-----+-----+-----+-----+
//          | r6  | m2  | m3  | r7  |
//     3m-1 +-----+-----+-----+-----+
//          | r8  | r9  | r10 | r11 |
//     4m-2 +-----+-----+-----+-----+
//
// The outer border conforms to the next coarser level: its odd vertices are left out, so its edges are the
// coarser level's and there are no T-junctions. (The paper covers T-junctions with triangles without area.)
struct WindowPattern {
  int m = 0, n = 0;  // n = 4m - 1 vertices per side
  int side = 0;      // row length of the vertex lattice: the least power of two > n
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> rows;  // the first index of each row of each block, and the end of the last
  std::vector<Block> ring;          // twelve blocks around the middle of 2m × 2m cells
  std::vector<Block> middle;        // four blocks that fill the middle, for the finest level
  // The hole has 2m - 1 cells per side and begins at cell m - 1 or m on either axis. What it leaves of the
  // middle is an L of one row and one column: trims[2·k] and trims[2·k + 1] for k = 2·(hole_z - (m - 1)) +
  // hole_x - (m - 1).
  std::vector<Block> trims;
};

// m ≥ 2. `conforming`: false keeps the odd vertices of the outer border, with gaps to the coarser level.
WindowPattern make_window_pattern(int m, bool conforming = true);

// Appends the index ranges of the block's triangles that have plan area when vertices are clamped to
// low … high, samples of the window, without the cells from sample hole_low to sample hole_high (equal: no
// hole), none of which may lie at the window's border. One range, or one or two per row if an edge of the
// ground or the hole cuts the block's rows. O(rows).
void append_outside(const WindowPattern&, const Block&, glm::ivec2 low, glm::ivec2 high, glm::ivec2 hole_low,
                    glm::ivec2 hole_high, std::vector<IndexRange>&);

}  // namespace terrabench::clipmap
