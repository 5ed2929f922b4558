// The triangles that a frame draws, as a set: whether two frames draw the same, however their triangles are
// ordered and wherever each begins. Each triangle is its positions' hash of 64 bits, so two different frames
// pass for the same with a probability below 2^-30 even at millions of triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/frame.h"

namespace terrabench {

class TriangleSet {
 public:
  // O(triangles log triangles). Triangles that are drawn twice count twice; those with two equal corners do
  // not count.
  explicit TriangleSet(const Frame&);

  std::size_t size() const { return hashes_.size(); }
  // How many of these triangles the other frame does not draw. O(triangles)
  std::size_t missing_in(const TriangleSet& other) const;
  bool operator==(const TriangleSet&) const = default;

 private:
  std::vector<std::uint64_t> hashes_;  // ascending
};

}  // namespace terrabench
