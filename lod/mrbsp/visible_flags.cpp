#include "lod/mrbsp/visible_flags.h"

namespace terrabench {

VisibleFlags::VisibleFlags(const VisibilityTable& table)
    : depth_(table.depth), flags_(((std::size_t{2} << table.depth) + 63) / 64) {
  for (const std::uint32_t element : table.start) toggle((NodeNumber{1} << table.depth) + element);
}

void VisibleFlags::toggle(NodeNumber leaf) {
  const auto flip = [&](NodeNumber node) { flags_[node / 64] ^= std::uint64_t{1} << (node % 64); };
  flip(leaf);
  for (NodeNumber node = leaf / 2; node >= 1; node /= 2) {
    const bool visible = (*this)[2 * node] || (*this)[2 * node + 1];
    if (visible == (*this)[node]) return;
    flip(node);
  }
}

std::size_t VisibleFlags::move_to(const VisibilityTable& table, glm::ivec2 cell) {
  const NodeNumber level = NodeNumber{1} << table.depth;
  std::size_t toggled = 0;
  const auto take = [&](int step) {
    for (const std::uint32_t element : table.step(step)) toggle(level + element);
    toggled += table.step(step).size();
  };
  for (; cell_.x < cell.x; ++cell_.x) take(table.step_right(cell_.x, cell_.y));
  for (; cell_.x > cell.x; --cell_.x) take(table.step_right(cell_.x - 1, cell_.y));
  for (; cell_.y < cell.y; ++cell_.y) take(table.step_down(cell_.x, cell_.y));
  for (; cell_.y > cell.y; --cell_.y) take(table.step_down(cell_.x, cell_.y - 1));
  return toggled;
}

}  // namespace terrabench
