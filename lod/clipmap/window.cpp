#include "lod/clipmap/window.h"

#include <array>
#include <bit>

namespace terrabench::clipmap {
namespace {

class Builder {
 public:
  explicit Builder(Window& window) : window_(window) {}

  template <class Keep>
  Block block(int x0, int z0, int x1, int z1, Keep keep) {
    Block block{static_cast<std::uint32_t>(window_.indices.size()), 0, x0, z0, x1, z1};
    for (int b = z0; b < z1; ++b) {
      for (int a = x0; a < x1; ++a) {
        if (!keep(a, b)) continue;
        triangle({a, b}, {a, b + 1}, {a + 1, b});
        triangle({a + 1, b}, {a, b + 1}, {a + 1, b + 1});
      }
    }
    block.index_count = static_cast<std::uint32_t>(window_.indices.size()) - block.first_index;
    return block;
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

}  // namespace

Window make_window(int m) {
  Window window;
  window.m = m;
  window.n = 4 * m - 1;
  window.side = static_cast<int>(std::bit_ceil(static_cast<unsigned>(window.n + 1)));
  const std::array cuts = {0, m - 1, 2 * m, 3 * m - 1, 4 * m - 2};
  Builder build(window);
  const auto every = [](int, int) { return true; };
  for (int bz = 0; bz < 4; ++bz) {
    for (int bx = 0; bx < 4; ++bx) {
      const bool inner = (bx == 1 || bx == 2) && (bz == 1 || bz == 2);
      (inner ? window.middle : window.ring)
          .push_back(build.block(cuts[bx], cuts[bz], cuts[bx + 1], cuts[bz + 1], every));
    }
  }
  const int hole = 2 * m - 1;
  for (int z = m - 1; z <= m; ++z) {
    for (int x = m - 1; x <= m; ++x) {
      window.trims.push_back(build.block(m - 1, m - 1, 3 * m - 1, 3 * m - 1, [=](int a, int b) {
        return a < x || a >= x + hole || b < z || b >= z + hole;
      }));
    }
  }
  return window;
}

}  // namespace terrabench::clipmap
