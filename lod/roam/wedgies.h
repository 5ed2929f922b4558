// Nested bounds of the vertical error of every bintree triangle ("wedgies", Duchaineau et al. 1997, §6.1):
// all samples over a triangle lie within its thickness of its plane, and so do the wedgies of its
// descendants. One bound serves the two triangles that split together, so it is kept by the lattice point
// that their split brings in, as 16 bits rounded up (8 of exponent): 2 bytes a lattice point. Points of one
// step size lie together, so that a mesh much coarser than the lattice touches little memory. Built
// bottom-up, level by level in parallel, O(points).
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

  // Of the triangles that lattice point (u, v) splits; 0 where all samples lie in the triangles' planes.
  float thickness(int u, int v) const { return decode(bounds_[place(u, v)]); }
  void prefetch(int u, int v) const { __builtin_prefetch(&bounds_[place(u, v)]); }
  Memory memory() const { return index_memory(bounds_); }

 private:
  struct Builder;
  static float decode(std::uint16_t bits) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
  }

  // A point in the middle of an edge or a square of 2s steps, s = 2^k, has multiples of s as its coordinates,
  // odd ones at least in part. Each square of 2s steps owns three such points: in the middle of its north
  // edge, of its west edge, and of itself. Those of one k are kept square by square.
  std::size_t place(int u, int v) const {
    const int k = std::countr_zero(static_cast<unsigned>(u | v));
    const std::size_t which = (u >> k & 1) + 2U * (v >> k & 1) - 1;
    const std::size_t row = v >> (k + 1), column = u >> (k + 1);
    return first_[k] + 3 * (row * squares(last_u_, k) + column) + which;
  }
  // In a line over the lattice, counting the one that only the border's points belong to.
  static std::size_t squares(int last, int k) { return static_cast<std::size_t>(last >> (k + 1)) + 1; }

  int last_u_;
  std::array<std::size_t, 32> first_{};  // of the points of each k
  std::vector<std::uint16_t> bounds_;
};

}  // namespace terrabench::roam
