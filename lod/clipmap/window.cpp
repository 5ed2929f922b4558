#include "lod/clipmap/window.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/common.hpp>

namespace terrabench::clipmap {
namespace {

class Builder {
 public:
  explicit Builder(Window& window) : window_(window) {}

  Block block(int x0, int z0, int x1, int z1) {
    const auto first = static_cast<std::uint32_t>(window_.indices.size());
    const auto first_row = static_cast<std::uint32_t>(window_.rows.size());
    for (int b = z0; b < z1; ++b) {
      window_.rows.push_back(static_cast<std::uint32_t>(window_.indices.size()));
      for (int a = x0; a < x1; ++a) {
        triangle({a, b}, {a, b + 1}, {a + 1, b});
        triangle({a + 1, b}, {a, b + 1}, {a + 1, b + 1});
      }
    }
    const auto end = static_cast<std::uint32_t>(window_.indices.size());
    return {{first, end - first}, x0, z0, x1, z1, first_row};
  }

 private:
  struct Vertex {
    int a, b;
    bool operator==(const Vertex&) const = default;
  };

  // Odd vertices of the border fall onto an even neighbour; the triangles around turn into a fan. Along the
  // far z border it is the other neighbour: two falling towards one corner would leave a triangle without
  // area.
  Vertex snap(Vertex v) const {
    const int last = window_.n - 1;
    if (v.b == 0) v.a &= ~1;
    if (v.b == last) v.a = (v.a + 1) & ~1;
    if (v.a == 0 || v.a == last) v.b &= ~1;
    return v;
  }

  void triangle(Vertex p, Vertex q, Vertex r) {
    const std::array<Vertex, 3> corners = {snap(p), snap(q), snap(r)};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    for (const Vertex& v : corners)
      window_.indices.push_back(static_cast<std::uint32_t>(v.b * window_.side + v.a));
  }

  Window& window_;
};

// The runs of one block, joined where one follows the other.
class Inside {
 public:
  Inside(const Window& window, glm::ivec2 low, glm::ivec2 high, std::vector<Run>& runs)
      : window_(window), low_(low), high_(high), runs_(runs), begin_(runs.size()) {}

  void add(std::uint32_t from, std::uint32_t to) {
    if (from >= to) return;
    if (runs_.size() > begin_ && runs_.back().first_index + runs_.back().index_count == from) {
      runs_.back().index_count += to - from;
    } else {
      runs_.push_back({from, to - from});
    }
  }
  // At the window's border triangles reach beyond their cell.
  void add_one_by_one(std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t at = from; at < to; at += 3) {
      const glm::ivec2 p = place(at), q = place(at + 1) - p, r = place(at + 2) - p;
      if (q.x * r.y != q.y * r.x) add(at, at + 3);
    }
  }

 private:
  glm::ivec2 place(std::uint32_t at) const {
    const auto vertex = static_cast<int>(window_.indices[at]);
    return glm::clamp(glm::ivec2(vertex % window_.side, vertex / window_.side), low_, high_);
  }

  const Window& window_;
  glm::ivec2 low_, high_;
  std::vector<Run>& runs_;
  std::size_t begin_;
};

}  // namespace

void append_inside(const Window& window, const Block& block, glm::ivec2 low, glm::ivec2 high,
                   std::vector<Run>& runs) {
  constexpr int kOfCell = 6;  // indices, away from the window's border
  low = glm::clamp(low, 0, window.n - 1);
  high = glm::clamp(high, 0, window.n - 1);
  const auto even_inside = [](int from, int to, int first, int last) {
    return (from & ~1) >= first && ((to + 1) & ~1) <= last;
  };
  if (even_inside(block.x0, block.x1, low.x, high.x) && even_inside(block.z0, block.z1, low.y, high.y)) {
    runs.push_back(block.indices);
    return;
  }
  Inside inside(window, low, high, runs);
  const int last = window.n - 2;  // cell
  const int x0 = std::max(block.x0, 1), x1 = std::min(block.x1, last);
  const int from = std::clamp(low.x, x0, x1), to = std::clamp(high.x, x0, x1);
  for (int z = block.z0; z < block.z1; ++z) {
    const std::uint32_t* const row = &window.rows[block.first_row + static_cast<std::uint32_t>(z - block.z0)];
    if (z == 0 || z == last) {
      inside.add_one_by_one(row[0], row[1]);
      continue;
    }
    // No block has cells of both the left and the right border.
    const auto regular = static_cast<std::uint32_t>(kOfCell * (x1 - x0));
    const std::uint32_t begin = block.x0 < x0 ? row[1] - regular : row[0];
    inside.add_one_by_one(row[0], begin);
    if (z >= low.y && z < high.y && from < to) {
      inside.add(begin + static_cast<std::uint32_t>(kOfCell * (from - x0)),
                 begin + static_cast<std::uint32_t>(kOfCell * (to - x0)));
    }
    inside.add_one_by_one(begin + regular, row[1]);
  }
}

Window make_window(int m) {
  Window window;
  window.m = m;
  window.n = 4 * m - 1;
  window.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(window.n + 1)));
  const std::array cuts = {0, m - 1, 2 * m, 3 * m - 1, 4 * m - 2};
  Builder build(window);
  for (int bz = 0; bz < 4; ++bz) {
    for (int bx = 0; bx < 4; ++bx) {
      const bool inner = (bx == 1 || bx == 2) && (bz == 1 || bz == 2);
      (inner ? window.middle : window.ring)
          .push_back(build.block(cuts[bx], cuts[bz], cuts[bx + 1], cuts[bz + 1]));
    }
  }
  const int hole = 2 * m - 1;
  for (int z = m - 1; z <= m; ++z) {
    for (int x = m - 1; x <= m; ++x) {
      const int row = z == m ? m - 1 : 3 * m - 2, column = x == m ? m - 1 : 3 * m - 2;
      window.trims.push_back(build.block(m - 1, row, 3 * m - 1, row + 1));
      window.trims.push_back(build.block(column, z, column + 1, z + hole));
    }
  }
  window.rows.push_back(static_cast<std::uint32_t>(window.indices.size()));
  return window;
}

}  // namespace terrabench::clipmap
