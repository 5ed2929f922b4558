// Nested bounds of the vertical error of every triangle ("wedgies", Duchaineau et al. 1997, §6.1): all
// samples over a triangle lie within its thickness of its plane, and so do the wedgies of its descendants.
// The two triangles of a diamond share one bound, stored at the lattice point that their split adds: 2 bytes
// per lattice point (8 bits of exponent), rounded up. Points of one step size are stored together, so that a
// mesh much coarser than the lattice touches little memory. Built bottom-up, level by level in parallel,
// O(points).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lod/roam/lattice.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"

namespace terrabench::roam {

class Wedgies {
 public:
  Wedgies(const Lattice&, const GroundGrid&, Progress&);

  // The heights under lattice points (u0, v0) … (u1, v1) have changed. Bounds nest, so that points up to 3s
  // steps away are computed again at step size s: O(points changed + log of all points).
  void update(const Lattice&, const GroundGrid&, int u0, int v0, int u1, int v1);

  // Thickness of the triangles that lattice point (u, v) splits, metres; 0 where all samples lie in their
  // planes.
  float thickness(int u, int v) const { return decode(bounds_[place(u, v)]); }
  void prefetch(int u, int v) const { __builtin_prefetch(&bounds_[place(u, v)]); }
  Memory memory() const { return index_memory(bounds_); }

 private:
  struct Builder;
  static float decode(std::uint16_t bits) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
  }

  // A point in the middle of an edge or a square of 2s steps, s = 2^k, has coordinates that are multiples of
  // s, at least one of them odd. Each square of 2s steps owns three such points: the middles of its north
  // edge, of its west edge and of itself. The points of one k are stored square by square.
  std::size_t place(int u, int v) const {
    const int k = std::countr_zero(static_cast<unsigned>(u | v));
    const std::size_t which = (u >> k & 1) + 2U * (v >> k & 1) - 1;
    const std::size_t row = v >> (k + 1), column = u >> (k + 1);
    return first_[k] + 3 * (row * squares(last_u_, k) + column) + which;
  }
  // Squares per row or column, including one at the far border that owns points of the border only.
  static std::size_t squares(int last, int k) { return static_cast<std::size_t>(last >> (k + 1)) + 1; }

  int last_u_;
  std::array<std::size_t, 32> first_{};  // index of the first point of each k
  std::vector<std::uint16_t> bounds_;
};

}  // namespace terrabench::roam
