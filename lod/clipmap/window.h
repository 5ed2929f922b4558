// The fixed triangles of a clipmap window (Losasso & Hoppe 2004, §3.1 and §3.4; Asirvatham & Hoppe 2005): n ×
// n vertices, n = 4m - 1, cut into blocks for culling, with the hole where the finer window lies. One index
// array serves all levels.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace terrabench::clipmap {

// A run of indices.
struct Run {
  std::uint32_t first_index = 0, index_count = 0;
};

// Those of cells [x0, x1) × [z0, z1) of the window, row by row. Vertex (a, b) is b·side + a.
struct Block {
  Run indices;
  int x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  std::uint32_t first_row = 0;  // of Window::rows
};

// The outer border is conforming: its odd vertices are left out, so that its edges are those of the coarser
// level and no T-junction is there to crack. (The paper hides them under triangles without area.)
struct Window {
  int m = 0, n = 0;  // n = 4m - 1 vertices a side
  int side = 0;      // rows of the vertex lattice: the power of two from n + 1 on
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> rows;  // the first index of each row of each block, and of what follows it
  std::vector<Block> ring;          // twelve blocks around the middle of 2m × 2m cells
  std::vector<Block> middle;        // the middle, for the finest level
  // The L-shaped strip between the middle and the hole of 2m - 1 cells, which lies at m - 1 or m on either
  // axis: its row and its column, trims[2·k] and [2·k + 1] with k = 2·(hole_z - (m - 1)) + hole_x - (m - 1).
  std::vector<Block> trims;
};

// m ≥ 2. O(n²).
Window make_window(int m);

// Appends what of the block has plan area when vertices outside low … high, samples of the window, stand at
// the nearest of these: as few runs as that takes, one a row where an edge parallel to z cuts the block.
// O(rows).
void append_inside(const Window&, const Block&, glm::ivec2 low, glm::ivec2 high, std::vector<Run>&);

}  // namespace terrabench::clipmap
