#include "representations/layered_stack/tile.h"

#include <array>
#include <cstring>
#include <limits>

namespace terrabench {
namespace {

// More runs need starts of 32 bits.
constexpr std::size_t kMostNarrowRuns = std::numeric_limits<std::uint16_t>::max();

// What an edit makes of a column: runs [first, end) become `count` others.
struct ColumnChange {
  std::size_t first, end, count = 0;
  std::array<Run, 2> runs{};  // their bottoms are not set
};

// A run is stored by its top alone, so one that is cut or joined at its lower end stays as it is. At most two
// are new: what is left below the edit, and the edit's own, unless the run above it or below it is joined.
ColumnChange change_of(const ColumnRuns& column, const Run& run) {
  const auto runs_up_to = [&](std::uint16_t top) {
    return static_cast<std::size_t>(std::upper_bound(column.tops, column.tops + column.count, top) -
                                    column.tops);
  };
  const auto material = [&](std::size_t r) {
    return r < column.count ? column.materials[r] : Material::kAir;
  };
  ColumnChange change{runs_up_to(run.bottom), runs_up_to(run.top)};
  const int bottom_of_first = change.first == 0 ? 0 : column.tops[change.first - 1];
  if (bottom_of_first < run.bottom) {
    const Material below = material(change.first);
    if (below != run.material) change.runs[change.count++] = {0, run.bottom, below};
  } else if (change.first > 0 && material(change.first - 1) == run.material) {
    --change.first;
  }
  if (material(change.end) != run.material) change.runs[change.count++] = run;
  return change;
}

}  // namespace

Memory StackTile::memory() const {
  const std::size_t index = (columns_ + 1U) * start_bytes();
  return {used_bytes() - index, index, heap_bytes(block_.get()) - used_bytes()};
}

bool StackTile::operator==(const StackTile& other) const {
  return columns_ == other.columns_ && runs_ == other.runs_ &&
         std::memcmp(block_.get(), other.block_.get(), used_bytes()) == 0;
}

bool StackTile::edit(std::size_t slot, const Run& run) {
  const ColumnChange change = change_of(column(slot), run);
  const std::size_t runs = runs_ + change.count - (change.end - change.first);
  if ((runs > kMostNarrowRuns) != wide_) return false;
  const std::size_t before = used_bytes(), after = used_bytes(runs);
  std::unique_ptr<std::byte[]> block;  // another one, unless the edit fits
  if (block_bytes(after) != block_bytes(before)) {
    block = std::make_unique_for_overwrite<std::byte[]>(block_bytes(after));
  }
  const auto move_to_block = [&](std::size_t used) {
    std::memcpy(block.get(), block_.get(), used);
    block_ = std::move(block);
  };
  if (block && after > before) move_to_block(before);
  const std::size_t first = start(slot);
  splice(first + change.first, first + change.end, std::span(change.runs).first(change.count));
  const auto shift_starts = [&](auto* starts) {
    using Start = std::remove_pointer_t<decltype(starts)>;
    const auto by = static_cast<Start>(runs - runs_);
    for (std::size_t s = slot + 1; s <= columns_; ++s) starts[s] = static_cast<Start>(starts[s] + by);
  };
  if (wide_) {
    shift_starts(reinterpret_cast<std::uint32_t*>(block_.get()));
  } else {
    shift_starts(reinterpret_cast<std::uint16_t*>(block_.get()));
  }
  runs_ = static_cast<std::uint32_t>(runs);
  if (block) move_to_block(after);
  return true;
}

// Replaces the tile's runs [first, end) by others, where the block has room; all but runs_ and the starts.
void StackTile::splice(std::size_t first, std::size_t end, std::span<const Run> by) {
  const std::size_t above = runs_ - end, new_end = first + by.size(), runs = new_end + above;
  auto* const all_tops = const_cast<std::uint16_t*>(tops());
  auto* const from = reinterpret_cast<Material*>(all_tops + runs_);
  auto* const to = reinterpret_cast<Material*>(all_tops + runs);
  const auto move_tops = [&] {
    std::memmove(all_tops + new_end, all_tops + end, above * sizeof(std::uint16_t));
  };
  // What moves up makes room first, highest first; what moves down, lowest first.
  if (runs > runs_) {
    std::memmove(to + new_end, from + end, above);
    std::memmove(to, from, first);
    move_tops();
  } else {
    move_tops();
    std::memmove(to, from, first);
    std::memmove(to + new_end, from + end, above);
  }
  for (std::size_t r = 0; r < by.size(); ++r) {
    all_tops[first + r] = by[r].top;
    to[first + r] = by[r].material;
  }
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
  tile.wide_ = tops_.size() > kMostNarrowRuns;
  tile.block_ = std::make_unique_for_overwrite<std::byte[]>(StackTile::block_bytes(tile.used_bytes()));
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
