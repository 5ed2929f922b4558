#include "lod/roam/draw_list.h"

#include <algorithm>

#include "terrain/memory.h"

namespace terrabench::roam {

// Zeroes the memory to touch its pages now: page faults would cost the first frame more than its splits.
DrawList::DrawList(std::size_t expected) : indices_(3 * expected), owners_(expected) {
  indices_.clear();
  owners_.clear();
}

void DrawList::add(std::vector<Node>& nodes, std::uint32_t id, std::uint32_t a, std::uint32_t b,
                   std::uint32_t c) {
  auto slot = static_cast<std::uint32_t>(owners_.size());
  if (free_.empty()) {
    owners_.push_back(id);
    indices_.resize(indices_.size() + 3);
  } else {
    slot = free_.back();
    free_.pop_back();
    owners_[slot] = id;
  }
  nodes[id].slot = slot;
  std::uint32_t* const vertices = indices_.data() + 3 * std::size_t{slot};
  vertices[0] = a;
  vertices[1] = b;
  vertices[2] = c;
  mark(slot);
}

void DrawList::remove(std::vector<Node>& nodes, std::uint32_t id) {
  const std::uint32_t slot = nodes[id].slot;
  if (slot == kNone) return;
  nodes[id].slot = kNone;
  owners_[slot] = kNone;
  free_.push_back(slot);
}

void DrawList::mark(std::uint32_t slot) {
  if (slot / 64 >= dirty_.size()) dirty_.resize(slot / 64 + 1);
  dirty_[slot / 64] |= std::uint64_t{1} << (slot % 64);
}

void DrawList::finish(std::vector<Node>& nodes, std::vector<DirtyRange>& uploads) {
  for (const std::uint32_t slot : free_) {
    while (!owners_.empty() && owners_.back() == kNone) owners_.pop_back();
    if (slot >= owners_.size()) continue;
    const std::uint32_t last = static_cast<std::uint32_t>(owners_.size()) - 1;
    std::copy_n(indices_.begin() + 3 * static_cast<std::ptrdiff_t>(last), 3,
                indices_.begin() + 3 * static_cast<std::ptrdiff_t>(slot));
    owners_[slot] = owners_[last];
    nodes[owners_[slot]].slot = slot;
    owners_.pop_back();
    mark(slot);
  }
  while (!owners_.empty() && owners_.back() == kNone) owners_.pop_back();
  free_.clear();
  indices_.resize(3 * owners_.size());
  for (std::size_t word = 0; word < dirty_.size(); ++word) {
    std::uint64_t bits = dirty_[word];
    dirty_[word] = 0;
    while (bits != 0) {
      const auto slot =
          static_cast<std::uint32_t>(word * 64) + static_cast<std::uint32_t>(std::countr_zero(bits));
      bits &= bits - 1;
      if (slot >= owners_.size()) continue;
      if (!uploads.empty() && uploads.back().first + uploads.back().count == 3 * slot) {
        uploads.back().count += 3;
      } else {
        uploads.push_back({.target = DirtyRange::Target::kIndices, .first = 3 * slot, .count = 3});
      }
    }
  }
}

Memory DrawList::memory() const {
  Memory memory = payload_memory(indices_);
  memory += index_memory(owners_, free_, dirty_);
  return memory;
}

}  // namespace terrabench::roam
