// A bounding volume hierarchy over boxes, which a ray visits one after the other, from near to far. No list
// of the boxes ahead is kept: a ray finds the next box from the last one alone. About 50 bytes per box.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderers/raytrace/ray_index.h"
#include "terrain/solid.h"

namespace terrabench {

// A box along a ray. Boxes are ordered by where the ray enters, then by number.
struct BoxVisit {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  float entry = -1;  // in lengths of the ray's direction, at least its `near`
  std::uint32_t box = kNone;
  bool found() const { return box != kNone; }
};

class BoxTree {
 public:
  // Throws bad_input for a box that is not finite or whose low exceeds its high. O(n log n)
  explicit BoxTree(std::span<const Bounds>);

  // The first box after `last` that the ray enters at `far` or before; kNone if there is none. Pass {} for
  // the first. Conservative: widened by rounding, so that no hit inside a box is missed. O(log n) on average.
  BoxVisit next(const Ray&, const BoxVisit& last, float far) const;

 private:
  struct Node {
    Bounds box;
    std::uint32_t first = 0;  // of its boxes in order_, or its right child; the left child follows the node
    std::uint32_t count = 0;  // 0: an inner node
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  std::vector<Bounds> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace terrabench
