#include "lod/geomipmap/patch_patterns.h"

#include <algorithm>
#include <utility>

namespace terrabench {
namespace {

struct Vertex {
  int i, j;  // in steps of the level
  bool operator==(const Vertex&) const = default;
};

// The vertex that is drawn in place of v. Seams to the north and west move odd vertices down, to the south
// and east up, so that each pair of fine edges becomes one edge around the inner vertex between its ends.
Vertex moved(Vertex v, int columns, int rows, int seams) {
  const bool odd_i = v.i % 2 != 0 && v.i < columns, odd_j = v.j % 2 != 0 && v.j < rows;
  const auto seam = [&](Side side) { return (seams >> side & 1) != 0; };
  if (odd_i && v.j == 0 && seam(kNorth)) return {v.i - 1, v.j};
  if (odd_i && v.j == rows && seam(kSouth)) return {v.i + 1, v.j};
  if (odd_j && v.i == 0 && seam(kWest)) return {v.i, v.j - 1};
  if (odd_j && v.i == columns && seam(kEast)) return {v.i, v.j + 1};
  return v;
}

}  // namespace

PatchPatterns::PatchPatterns(const PatchGrid& grid, int levels, Split split)
    : levels_(levels), split_(split), patterns_(static_cast<std::size_t>(4 * levels * 16)) {
  std::array<bool, 4> known{};
  for (const int at_z : {0, grid.down() - 1}) {
    for (const int at_x : {0, grid.across() - 1}) {
      const PatchGrid::Patch patch = grid.patch(at_x, at_z);
      const int shape = grid.shape(patch);
      if (std::exchange(known[static_cast<std::size_t>(shape)], true)) continue;
      for (int level = 0; level < levels; ++level) {
        for (int seams = 0; seams < (level + 1 < levels ? 16 : 1); ++seams) {
          patterns_[static_cast<std::size_t>((shape * levels + level) * 16 + seams)] =
              add(patch, grid.width, level, seams);
        }
      }
    }
  }
  indices_.shrink_to_fit();
}

IndexRange PatchPatterns::add(const PatchGrid::Patch& shape, int stride, int level, int seams) {
  const int step = 1 << level;
  const int columns = (shape.columns - 1) / step + 1, rows = (shape.rows - 1) / step + 1;
  const auto index_of = [&](Vertex v) {
    return static_cast<std::uint32_t>(std::min(v.j * step, shape.rows) * stride +
                                      std::min(v.i * step, shape.columns));
  };
  IndexRange range{static_cast<std::uint32_t>(indices_.size()), 0};
  const auto triangle = [&](Vertex a, Vertex b, Vertex c) {
    a = moved(a, columns, rows, seams);
    b = moved(b, columns, rows, seams);
    c = moved(c, columns, rows, seams);
    if (a == b || b == c || c == a) return;
    for (const Vertex& v : {a, b, c}) indices_.push_back(index_of(v));
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (split_ == Split::kOneWay || (i + j) % 2 != 0) {
        triangle({i, j}, {i, j + 1}, {i + 1, j});
        triangle({i + 1, j}, {i, j + 1}, {i + 1, j + 1});
      } else {
        triangle({i, j}, {i, j + 1}, {i + 1, j + 1});
        triangle({i, j}, {i + 1, j + 1}, {i + 1, j});
      }
    }
  }
  range.index_count = static_cast<std::uint32_t>(indices_.size()) - range.first_index;
  return range;
}

Memory PatchPatterns::memory() const {
  Memory memory = index_memory(patterns_);
  memory += payload_memory(indices_);
  return memory;
}

}  // namespace terrabench
