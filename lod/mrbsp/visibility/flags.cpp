#include "lod/mrbsp/visibility/flags.h"

namespace terrabench::mrbsp::visibility {

Flags::Flags(const ChangeTable& table)
    : depth_(table.depth), flags_(((std::size_t{2} << table.depth) + 63) / 64) {
  for (const std::uint32_t element : table.start) toggle(first_node(table.depth) + element);
}

void Flags::toggle(NodeNumber coarse_triangle) {
  const auto flip = [&](NodeNumber node) { flags_[node / 64] ^= std::uint64_t{1} << (node % 64); };
  flip(coarse_triangle);
  for (NodeNumber node = coarse_triangle / 2; node >= 1; node /= 2) {
    const bool visible = (*this)[2 * node] || (*this)[2 * node + 1];
    if (visible == (*this)[node]) return;
    flip(node);
  }
}

std::size_t Flags::move_to(const ChangeTable& table, glm::ivec2 cell) {
  std::size_t toggled = 0;
  const auto take = [&](int step) {
    for (const std::uint32_t element : table.step(step)) toggle(first_node(table.depth) + element);
    toggled += table.step(step).size();
  };
  for (; cell_.x < cell.x; ++cell_.x) take(table.step_right(cell_.x, cell_.y));
  for (; cell_.x > cell.x; --cell_.x) take(table.step_right(cell_.x - 1, cell_.y));
  for (; cell_.y < cell.y; ++cell_.y) take(table.step_down(cell_.x, cell_.y));
  for (; cell_.y > cell.y; --cell_.y) take(table.step_down(cell_.x, cell_.y - 1));
  return toggled;
}

}  // namespace terrabench::mrbsp::visibility
