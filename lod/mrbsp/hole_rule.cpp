#include "lod/mrbsp/hole_rule.h"

namespace terrabench {

Cuts::Cuts(const BisectionTree& tree) : tree_(tree) {
  const std::size_t along = static_cast<std::size_t>(tree.side()) + 1;
  bits_.resize((along * along + 63) / 64);
}

void Cuts::clear() {
  for (const std::uint32_t word : marked_) bits_[word] = 0;
  marked_.clear();
}

Memory Cuts::memory() const {
  Memory memory = index_memory(bits_);
  memory += index_memory(marked_);
  return memory;
}

}  // namespace terrabench
