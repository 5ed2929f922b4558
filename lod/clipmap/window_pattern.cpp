#include "lod/clipmap/window_pattern.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>

namespace terrabench::clipmap {
namespace {

class Builder {
 public:
  Builder(WindowPattern& pattern, bool conforming) : pattern_(pattern), conforming_(conforming) {}

  Block block(int x0, int z0, int x1, int z1) {
    const auto first = static_cast<std::uint32_t>(pattern_.indices.size());
    const auto first_row = static_cast<std::uint32_t>(pattern_.rows.size());
    for (int b = z0; b < z1; ++b) {
      pattern_.rows.push_back(static_cast<std::uint32_t>(pattern_.indices.size()));
      for (int a = x0; a < x1; ++a) {
        triangle({a, b}, {a, b + 1}, {a + 1, b});
        triangle({a + 1, b}, {a, b + 1}, {a + 1, b + 1});
      }
    }
    const auto end = static_cast<std::uint32_t>(pattern_.indices.size());
    return {{first, end - first}, x0, z0, x1, z1, first_row};
  }

 private:
  struct Vertex {
    int a, b;
    bool operator==(const Vertex&) const = default;
  };

  // Moves an odd vertex of the border to its lower even neighbour, so that the triangles around it become a
  // fan. Along the far z border it is the upper neighbour: otherwise two vertices would move towards one
  // corner and leave a triangle without area.
  Vertex snap(Vertex v) const {
    if (!conforming_) return v;
    const int last = pattern_.n - 1;
    if (v.b == 0) v.a &= ~1;
    if (v.b == last) v.a = (v.a + 1) & ~1;
    if (v.a == 0 || v.a == last) v.b &= ~1;
    return v;
  }

  void triangle(Vertex p, Vertex q, Vertex r) {
    const std::array<Vertex, 3> corners = {snap(p), snap(q), snap(r)};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    for (const Vertex& v : corners)
      pattern_.indices.push_back(static_cast<std::uint32_t>(v.b * pattern_.side + v.a));
  }

  WindowPattern& pattern_;
  bool conforming_;
};

// Collects the index ranges of one block; joins adjacent ones.
class Inside {
 public:
  Inside(const WindowPattern& pattern, glm::ivec2 low, glm::ivec2 high, std::vector<IndexRange>& ranges)
      : pattern_(pattern), low_(low), high_(high), ranges_(ranges), begin_(ranges.size()) {}

  void add(std::uint32_t from, std::uint32_t to) {
    if (from >= to) return;
    if (ranges_.size() > begin_ && ranges_.back().first_index + ranges_.back().index_count == from) {
      ranges_.back().index_count += to - from;
    } else {
      ranges_.push_back({from, to - from});
    }
  }
  // Tests triangles one by one, for cells at the window's border, whose triangles extend beyond their cell.
  void add_one_by_one(std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t at = from; at < to; at += 3) {
      const glm::ivec2 p = place(at), q = place(at + 1) - p, r = place(at + 2) - p;
      if (q.x * r.y != q.y * r.x) add(at, at + 3);
    }
  }

 private:
  glm::ivec2 place(std::uint32_t at) const {
    const auto vertex = static_cast<int>(pattern_.indices[at]);
    return glm::clamp(glm::ivec2(vertex % pattern_.side, vertex / pattern_.side), low_, high_);
  }

  const WindowPattern& pattern_;
  glm::ivec2 low_, high_;
  std::vector<IndexRange>& ranges_;
  std::size_t begin_;
};

constexpr int kOfCell = 6;  // indices per cell away from the window's border

}  // namespace

void append_outside(const WindowPattern& pattern, const Block& block, glm::ivec2 low, glm::ivec2 high,
                    glm::ivec2 hole_low, glm::ivec2 hole_high, std::vector<IndexRange>& ranges) {
  low = glm::clamp(low, 0, pattern.n - 1);
  high = glm::clamp(high, 0, pattern.n - 1);
  const auto even_inside = [](int from, int to, int first, int last) {
    return (from & ~1) >= first && ((to + 1) & ~1) <= last;
  };
  const bool cut =
      hole_low.x < block.x1 && hole_high.x > block.x0 && hole_low.y < block.z1 && hole_high.y > block.z0;
  if (!cut && even_inside(block.x0, block.x1, low.x, high.x) &&
      even_inside(block.z0, block.z1, low.y, high.y)) {
    ranges.push_back(block.indices);
    return;
  }
  Inside inside(pattern, low, high, ranges);
  const int last = pattern.n - 2;  // cell
  const int x0 = std::max(block.x0, 1), x1 = std::min(block.x1, last);
  const int from = std::clamp(low.x, x0, x1), to = std::clamp(high.x, x0, x1);
  for (int z = block.z0; z < block.z1; ++z) {
    const std::uint32_t* const row =
        &pattern.rows[block.first_row + static_cast<std::uint32_t>(z - block.z0)];
    if (z == 0 || z == last) {
      inside.add_one_by_one(row[0], row[1]);
      continue;
    }
    // A block has cells at the left or the right border, not both.
    const auto regular = static_cast<std::uint32_t>(kOfCell * (x1 - x0));
    const std::uint32_t begin = block.x0 < x0 ? row[1] - regular : row[0];
    inside.add_one_by_one(row[0], begin);
    if (z >= low.y && z < high.y && from < to) {
      const auto at = [&](int x) { return begin + static_cast<std::uint32_t>(kOfCell * (x - x0)); };
      const bool in_hole = z >= hole_low.y && z < hole_high.y;
      inside.add(at(from), at(in_hole ? std::clamp(hole_low.x, from, to) : to));
      if (in_hole) inside.add(at(std::clamp(hole_high.x, from, to)), at(to));
    }
    inside.add_one_by_one(begin + regular, row[1]);
  }
}

WindowPattern make_window_pattern(int m, bool conforming) {
  WindowPattern pattern;
  pattern.m = m;
  pattern.n = 4 * m - 1;
  pattern.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(pattern.n + 1)));
  const std::array cuts = {0, m - 1, 2 * m, 3 * m - 1, 4 * m - 2};
  Builder build(pattern, conforming);
  for (int bz = 0; bz < 4; ++bz) {
    for (int bx = 0; bx < 4; ++bx) {
      const bool inner = (bx == 1 || bx == 2) && (bz == 1 || bz == 2);
      (inner ? pattern.middle : pattern.ring)
          .push_back(build.block(cuts[bx], cuts[bz], cuts[bx + 1], cuts[bz + 1]));
    }
  }
  const int hole = 2 * m - 1;
  for (int z = m - 1; z <= m; ++z) {
    for (int x = m - 1; x <= m; ++x) {
      const int row = z == m ? m - 1 : 3 * m - 2, column = x == m ? m - 1 : 3 * m - 2;
      pattern.trims.push_back(build.block(m - 1, row, 3 * m - 1, row + 1));
      pattern.trims.push_back(build.block(column, z, column + 1, z + hole));
    }
  }
  pattern.rows.push_back(static_cast<std::uint32_t>(pattern.indices.size()));
  return pattern;
}

}  // namespace terrabench::clipmap
