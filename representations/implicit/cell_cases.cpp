#include "representations/implicit/cell_cases.h"

#include <limits>
#include <span>

namespace terrabench {
namespace {

constexpr int kLongest = 7;  // edges of a loop

// The other two axes, in the order x, y, z.
constexpr std::array<std::array<int, 2>, 3> kAcross{{{1, 2}, {0, 2}, {0, 1}}};

int edge_between(int a, int b) {
  const int axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2, low = a < b ? a : b;
  return 4 * axis + ((low >> kAcross[axis][0]) & 1) + 2 * ((low >> kAcross[axis][1]) & 1);
}

bool on_one_face(int a, int b) {
  const auto position = [](int edge, int axis) {  // 0 or 1; 2: along the axis
    const auto& across = kAcross[edge / 4];
    return across[0] == axis ? edge & 1 : across[1] == axis ? edge >> 1 & 1 : 2;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (position(a, axis) == position(b, axis) && position(a, axis) < 2) return true;
  }
  return false;
}

// next[e]: the edge that follows e on its loop, -1 where the surface does not cross.
std::array<int, 12> trace(int solid) {
  std::array<int, 12> next;
  next.fill(-1);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      // Counter-clockwise from outside the cell.
      std::array<int, 4> corners{0, 1 << b, 1 << b | 1 << c, 1 << c};
      if (side == 0) corners = {0, 1 << c, 1 << b | 1 << c, 1 << b};
      for (int& corner : corners) corner |= side << axis;
      const auto is_solid = [&](int m) {
        return (solid >> corners[static_cast<std::size_t>(m % 4)] & 1) != 0;
      };
      const auto edge = [&](int m) {
        return edge_between(corners[static_cast<std::size_t>(m % 4)],
                            corners[static_cast<std::size_t>((m + 1) % 4)]);
      };
      for (int m = 0; m < 4; ++m) {
        if (is_solid(m) || !is_solid(m + 1)) continue;  // corner m + 1 begins a row of solid corners
        int last = m + 1;
        while (is_solid(last + 1)) ++last;
        next[static_cast<std::size_t>(edge(m))] = edge(last);
      }
    }
  }
  return next;
}

// Divides the polygon of loop[from … to] into triangles with the fewest diagonals on faces of the cell (none
// is needed in any case). Returns their number; appends the triangles when `out` is given.
int divide(std::span<const int> loop, int from, int to, CellCase* out) {
  if (to - from < 2) return 0;
  int best = std::numeric_limits<int>::max(), best_at = from + 1;
  const auto diagonal = [&](int a, int b) {
    const bool side = b - a == 1 || (a == 0 && b == static_cast<int>(loop.size()) - 1);
    return !side && on_one_face(loop[static_cast<std::size_t>(a)], loop[static_cast<std::size_t>(b)]) ? 1 : 0;
  };
  for (int at = from + 1; at < to; ++at) {
    const int cost = diagonal(from, at) + diagonal(at, to) + divide(loop, from, at, nullptr) +
                     divide(loop, at, to, nullptr);
    if (cost < best) {
      best = cost;
      best_at = at;
    }
  }
  if (out != nullptr) {
    divide(loop, from, best_at, out);
    divide(loop, best_at, to, out);
    for (const int corner : {from, best_at, to}) {
      const auto slot = static_cast<std::size_t>(3 * out->triangles + (corner == from ? 0
                                                                       : corner == to ? 2
                                                                                      : 1));
      out->corners[slot] = static_cast<std::uint8_t>(loop[static_cast<std::size_t>(corner)]);
    }
    ++out->triangles;
  }
  return best;
}

std::array<CellCase, 256> derive() {
  std::array<CellCase, 256> cases;
  for (int solid = 0; solid < 256; ++solid) {
    CellCase& made = cases[static_cast<std::size_t>(solid)];
    made.loop_of.fill(kNoLoop);
    const std::array<int, 12> next = trace(solid);
    for (int first = 0; first < 12; ++first) {
      if (next[static_cast<std::size_t>(first)] < 0 ||
          made.loop_of[static_cast<std::size_t>(first)] != kNoLoop) {
        continue;
      }
      std::array<int, kLongest> loop{};
      int length = 0, edge = first;
      do {
        loop[static_cast<std::size_t>(length++)] = edge;
        made.loop_of[static_cast<std::size_t>(edge)] = made.loops;
        edge = next[static_cast<std::size_t>(edge)];
      } while (edge != first);
      divide(std::span(loop).first(static_cast<std::size_t>(length)), 0, length - 1, &made);
      ++made.loops;
    }
  }
  return cases;
}

}  // namespace

const std::array<CellCase, 256>& cell_cases() {
  static const std::array<CellCase, 256> kCases = derive();
  return kCases;
}

}  // namespace terrabench
