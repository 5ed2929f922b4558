// A square of neighbouring material stacks in one heap block: where each column starts, then all levels, then
// all materials. 2 B per column and 3 B per run; nothing is allocated per column.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "representations/runs.h"
#include "terrain/memory.h"

namespace terrabench {

// The runs of one column, bottom up: run r reaches from tops[r-1] (0 for the first) to tops[r]. Air above the
// last.
struct ColumnRuns {
  const std::uint16_t* tops;
  const Material* materials;
  std::size_t count;

  int highest() const { return count == 0 ? 0 : tops[count - 1]; }  // solid level; 0 if all is air
  // How many runs lie on one another from the floor up without air.
  std::size_t grounded() const {
    return static_cast<std::size_t>(std::find(materials, materials + count, Material::kAir) - materials);
  }
  // Calls visit(bottom, top, material) for each run that is not air, upward.
  template <class Visit>
  void each_solid(const Visit& visit) const {
    std::uint16_t bottom = 0;
    for (std::size_t r = 0; r < count; bottom = tops[r++]) {
      if (materials[r] != Material::kAir) visit(bottom, tops[r], materials[r]);
    }
  }
};

class StackTile {
 public:
  static constexpr int kSide = 16;  // 8 costs 0.4 B per column more, 32 makes edits four times slower

  StackTile() = default;

  ColumnRuns column(std::size_t slot) const {
    const std::size_t first = start(slot);
    return {tops() + first, materials() + first, start(slot + 1) - first};
  }
  std::size_t columns() const { return columns_; }
  std::size_t runs() const { return runs_; }
  // Sets levels [bottom, top) of a column, within the block where that keeps its size. Strong guarantee.
  // False where the number of runs asks for starts of another width: nothing is done. O(runs of the tile).
  bool edit(std::size_t slot, const Run&);
  // For prefetching: the address of column()'s first read and, when the starts are in the cache, of its
  // second.
  const void* start_address(std::size_t slot) const { return block_.get() + slot * start_bytes(); }
  const void* tops_address(std::size_t slot) const { return tops() + start(slot); }
  const void* materials_address(std::size_t slot) const { return materials() + start(slot); }
  Memory memory() const;
  bool operator==(const StackTile&) const;

 private:
  friend class TileBuilder;
  std::size_t start_bytes() const { return wide_ ? sizeof(std::uint32_t) : sizeof(std::uint16_t); }
  std::size_t start(std::size_t slot) const {
    return wide_ ? reinterpret_cast<const std::uint32_t*>(block_.get())[slot]
                 : reinterpret_cast<const std::uint16_t*>(block_.get())[slot];
  }
  std::size_t used_bytes() const { return used_bytes(runs_); }
  std::size_t used_bytes(std::size_t runs) const {
    return (columns_ + 1U) * start_bytes() + runs * (sizeof(std::uint16_t) + sizeof(Material));
  }
  // The block's size: as operator new rounds it in any case (heap_bytes()), so that most edits fit.
  static std::size_t block_bytes(std::size_t used) { return (used + 8 + 31) / 32 * 32 - 8; }
  void splice(std::size_t first, std::size_t end, std::span<const Run> by);
  const std::uint16_t* tops() const {
    return reinterpret_cast<const std::uint16_t*>(block_.get() + (columns_ + 1U) * start_bytes());
  }
  const Material* materials() const { return reinterpret_cast<const Material*>(tops() + runs_); }

  std::unique_ptr<std::byte[]> block_;
  std::uint32_t runs_ = 0;
  std::uint16_t columns_ = 0;
  bool wide_ = false;  // more than 65535 runs, so that starts take 32 bits
};

// Scratch that collects a tile's columns and lays them out. Reused, it allocates only the tiles.
class TileBuilder {
 public:
  void begin() {
    starts_.assign(1, 0);
    tops_.clear();
    materials_.clear();
  }
  void add(std::span<const Run> column) {
    for (const Run& run : column) {
      tops_.push_back(run.top);
      materials_.push_back(run.material);
    }
    end_column();
  }
  // Slots [first, end) of a tile, unchanged.
  void add(const StackTile&, std::size_t first, std::size_t end);
  StackTile finish() const;

 private:
  void end_column() { starts_.push_back(static_cast<std::uint32_t>(tops_.size())); }

  std::vector<std::uint32_t> starts_;
  std::vector<std::uint16_t> tops_;
  std::vector<Material> materials_;
};

}  // namespace terrabench
