// The right triangles of recursive bisection over a field of any size (Evans, Kirkpatrick and Townsend, 2001,
// §2): root squares of 2ⁿ × 2ⁿ cells, each of two triangles, cover the ground from sample (0, 0) on. A
// lattice point beyond the last row or column of samples lies over the last one, which moves it along the
// axes alone: triangles keep their orientation or have no area, and those with an area cover the ground
// exactly.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace terrabench::rtin {

// Corners are lattice points, counter-clockwise from above. The hypotenuse runs from a to b; a triangle is
// split at its middle.
struct Triangle {
  glm::ivec2 a, b, c;

  bool splits() const { return std::abs(a.x - c.x) + std::abs(a.y - c.y) > 1; }
  glm::ivec2 middle() const { return (a + b) / 2; }
  std::pair<Triangle, Triangle> halves() const { return {{c, a, middle()}, {b, c, middle()}}; }
};

struct Lattice {
  // The largest root squares that cover at most a quarter more cells than the ground has.
  Lattice(int width, int depth) : last(width - 1, depth - 1) {
    side_log = 30;
    const auto cells = [&] {
      const glm::dvec2 squares = glm::ceil(glm::dvec2(last) / std::ldexp(1.0, side_log));
      return std::ldexp(squares.x * squares.y, 2 * side_log);
    };
    while (cells() > 1.25 * last.x * last.y) --side_log;
    roots = (last - 1) / (1 << side_log) + 1;
  }

  glm::ivec2 size() const { return roots * (1 << side_log) + 1; }  // lattice points
  glm::ivec2 sample(glm::ivec2 point) const { return glm::min(point, last); }
  std::uint32_t vertex(glm::ivec2 point) const {
    const glm::ivec2 at = sample(point);
    return static_cast<std::uint32_t>(at.y) * static_cast<std::uint32_t>(last.x + 1) +
           static_cast<std::uint32_t>(at.x);
  }
  // Whether there is ground below it.
  bool over_ground(const Triangle& t) const {
    const glm::ivec2 low = glm::min(glm::min(t.a, t.b), t.c);
    return low.x < last.x && low.y < last.y;
  }

  // Calls use(triangle) for the two triangles of a square. Diagonals of neighbouring squares mirror each
  // other, so that legs meet legs.
  template <class Use>
  static void halves_of_square(glm::ivec2 low, int side, const Use& use) {
    const glm::ivec2 high = low + side, east{high.x, low.y}, south{low.x, high.y};
    if ((low.x / side + low.y / side) % 2 == 0) {
      use(Triangle{low, high, east});
      use(Triangle{high, low, south});
    } else {
      use(Triangle{south, east, low});
      use(Triangle{east, south, high});
    }
  }

  glm::ivec2 last;  // sample
  int side_log;     // n
  glm::ivec2 roots;
};

enum class Next : std::uint8_t { kSkip, kDraw, kSplit };

// Descends from a triangle: choose(triangle, state) says what becomes of it, and may change its copy of the
// state, which the halves then start from. Calls draw(triangle) for those chosen.
template <class State, class Choose, class Draw>
void descend(const Triangle& t, State state, const Choose& choose, const Draw& draw) {
  const Next next = choose(t, state);
  if (next == Next::kDraw) draw(t);
  if (next != Next::kSplit) return;
  const auto [left, right] = t.halves();
  descend(left, state, choose, draw);
  descend(right, state, choose, draw);
}

// Likewise from all roots.
template <class State, class Choose, class Draw>
void descend(const Lattice& lattice, const State& state, const Choose& choose, const Draw& draw) {
  const int side = 1 << lattice.side_log;
  for (int z = 0; z < lattice.roots.y; ++z) {
    for (int x = 0; x < lattice.roots.x; ++x) {
      Lattice::halves_of_square(glm::ivec2(x, z) * side, side,
                                [&](const Triangle& root) { descend(root, state, choose, draw); });
    }
  }
}

}  // namespace terrabench::rtin
