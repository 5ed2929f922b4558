// Visible sets, computed before rendering (MRBSP paper, §4). The ground is divided into rectangular cells in
// plan. The visible set of a cell holds the coarse triangles that an observer anywhere in the cell can see.
// Coarse triangles are the nodes of one odd depth of the tree, so each is half of a square
// (coarse_squares.h). A coarse triangle is shown or hidden together with its whole subtree.
//
//   compute   find_sets(), here     by Mode: line_of_sight.h (sampled) or area_occlusion.h (conservative)
//   compress  change_table.h        the first cell's set and the changes between neighbouring cells
//   store     codec.h               a change table as text, as bytes, as a file
//   use       Flags, change_table.h one flag per node, toggled as the observer moves (Mrbsp::update())
//
// Cost: cells × coarse triangles × length of a line of sight, in parallel over cells; from all samples
// (kVertices) samples in place of cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "lod/mrbsp/bisection_tree.h"
#include "terrain/frame.h"
#include "terrain/progress.h"

namespace terrabench::mrbsp::visibility {

// How the sets are computed.
enum class Mode : std::uint8_t {
  kSampled,       // as printed: from the corners of the cell to the vertices of the coarse triangles
  kConservative,  // area to area over the full surface; misses none for an eye that is not below the surface
  kVertices,      // as kSampled, from all samples in the cell
  kFacing,        // as kSampled, for triangles that face the eye
  kInterior,      // as kFacing, from 2 × 2 places inside the cell, evenly spaced
};
// All but kConservative sample the coarse surface (line_of_sight.h) and may miss visible triangles.
inline constexpr std::array<std::string_view, 5> kModeNames{"sampled", "conservative", "vertices", "facing",
                                                            "interior"};
inline std::string_view name_of(Mode mode) { return kModeNames[static_cast<std::size_t>(mode)]; }

struct Options {
  Mode mode = Mode::kConservative;
  int cells = 16;           // most cells along the longer side of the ground, 1 to 1024
  int coarseness = 6;       // levels from the finest to the coarse triangles; 1 more if the depth is even
  float eye_height = 1.8F;  // metres above the ground, 0 to 1e6
};

// Cells are squares of `side` samples, a power of two; the last row and column end at the field's border.
struct CellGrid {
  int columns = 1, rows = 1, side = 1;
  int count() const { return columns * rows; }
  // Column and row of the cell at a position in samples, which must lie in the field.
  glm::ivec2 cell_at(float x, float z) const {
    return {std::min(static_cast<int>(x) / side, columns - 1),
            std::min(static_cast<int>(z) / side, rows - 1)};
  }
  bool operator==(const CellGrid&) const = default;
};

// Identifies the ground for which sets were computed: 32 hex digits, from samples, spacing and tree.
using GroundChecksum = std::array<char, 32>;
GroundChecksum ground_checksum(const GroundGrid&, const BisectionTree&);

// One bit per cell and coarse triangle. The coarse triangles of depth C are numbered by `element`: element e
// is node 2^C + e of the tree.
struct Sets {
  CellGrid cells;
  int depth = 1;          // C
  std::size_t words = 1;  // per cell
  float eye_height = 0;   // metres
  GroundChecksum ground{};
  Mode mode = Mode::kSampled;
  std::vector<std::uint64_t> bits;

  Sets() = default;
  // Empty sets. Throws usage_error beyond 512 MiB.
  Sets(CellGrid cells, int depth, float eye_height);
  bool sees(int cell, std::uint32_t element) const {
    return ((bits[cell * words + element / 64] >> (element % 64)) & 1) != 0;
  }
  void add(int cell, std::uint32_t element) {
    bits[cell * words + element / 64] |= std::uint64_t{1} << (element % 64);
  }
  std::size_t count(int cell) const;
  bool operator==(const Sets&) const = default;
};

// The cells, and the depth of the coarse triangles (at most kDeepestCoarse), that result from the options on
// this ground. layout_of() throws usage_error for options out of range.
inline constexpr int kDeepestCoarse = 24;
struct Layout {
  CellGrid cells;
  int depth = 1;
};
Layout layout_of(const GroundGrid&, const BisectionTree&, const Options&);

// Throws usage_error for options out of range or sets beyond 512 MiB. The result does not depend on the
// number of threads.
Sets find_sets(const GroundGrid&, const BisectionTree&, const Options&, Progress&);

}  // namespace terrabench::mrbsp::visibility
