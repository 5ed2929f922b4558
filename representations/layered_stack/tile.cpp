#include "representations/layered_stack/tile.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace terrabench {

Memory StackTile::memory() const {
  const std::size_t index = (columns_ + 1U) * start_bytes();
  return {used_bytes() - index, index, heap_bytes(block_.get()) - used_bytes()};
}

bool StackTile::operator==(const StackTile& other) const {
  return columns_ == other.columns_ && runs_ == other.runs_ &&
         std::memcmp(block_.get(), other.block_.get(), used_bytes()) == 0;
}

void TileBuilder::add(const StackTile& tile, std::size_t first, std::size_t end) {
  const std::size_t begin_run = tile.start(first), end_run = tile.start(end), begin = tops_.size();
  for (std::size_t slot = first; slot < end; ++slot) {
    starts_.push_back(static_cast<std::uint32_t>(begin + tile.start(slot + 1) - begin_run));
  }
  tops_.insert(tops_.end(), tile.tops() + begin_run, tile.tops() + end_run);
  materials_.insert(materials_.end(), tile.materials() + begin_run, tile.materials() + end_run);
}

StackTile TileBuilder::finish() const {
  StackTile tile;
  tile.runs_ = static_cast<std::uint32_t>(tops_.size());
  tile.columns_ = static_cast<std::uint16_t>(starts_.size() - 1);
  tile.wide_ = tops_.size() > std::numeric_limits<std::uint16_t>::max();
  tile.block_ = std::make_unique_for_overwrite<std::byte[]>(tile.used_bytes());
  std::byte* out = tile.block_.get();
  if (tile.wide_) {
    std::copy(starts_.begin(), starts_.end(), reinterpret_cast<std::uint32_t*>(out));
  } else {
    std::transform(starts_.begin(), starts_.end(), reinterpret_cast<std::uint16_t*>(out),
                   [](std::uint32_t start) { return static_cast<std::uint16_t>(start); });
  }
  out += starts_.size() * tile.start_bytes();
  std::copy(tops_.begin(), tops_.end(), reinterpret_cast<std::uint16_t*>(out));
  std::copy(materials_.begin(), materials_.end(),
            reinterpret_cast<Material*>(out + tops_.size() * sizeof tops_[0]));
  return tile;
}

}  // namespace terrabench
