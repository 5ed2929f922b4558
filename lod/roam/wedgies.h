// Nested bounds of the vertical error of every bintree triangle ("wedgies", Duchaineau et al. 1997, §6.1):
// all samples over a triangle lie within its thickness of its plane, and so do the wedgies of its
// descendants. One bound serves the two triangles that split together, so it is kept by the lattice point
// that their split brings in, as 16 bits rounded up (8 of exponent): 2 bytes a lattice point. Built
// bottom-up, level by level in parallel, O(points).
#pragma once

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
  float thickness(int u, int v) const { return decode(bounds_[static_cast<std::size_t>(v) * width_ + u]); }
  void prefetch(int u, int v) const {
    __builtin_prefetch(&bounds_[static_cast<std::size_t>(v) * width_ + u]);
  }
  Memory memory() const { return index_memory(bounds_); }

 private:
  struct Builder;
  static float decode(std::uint16_t bits) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
  }

  std::size_t width_;
  std::vector<std::uint16_t> bounds_;
};

}  // namespace terrabench::roam
