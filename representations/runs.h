// Runs of equal material along one column, shared by stacks, voxels and their edits.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "terrain/solid.h"

namespace terrabench {

// Levels [bottom, top) of one column hold one material.
struct Run {
  std::uint16_t bottom = 0, top = 0;
  Material material = Material::kAir;
  bool operator==(const Run&) const = default;
};

// The end of the run that begins at `begin`: the first later sample of another material, or the column's end.
// Eight samples per step.
inline std::size_t run_end(std::span<const Material> column, std::size_t begin) {
  const std::uint64_t same = 0x0101010101010101U * static_cast<std::uint64_t>(column[begin]);
  std::size_t at = begin + 1;
  for (; at + sizeof same <= column.size(); at += sizeof same) {
    std::uint64_t eight;
    std::memcpy(&eight, column.data() + at, sizeof eight);
    if (eight != same) return at + static_cast<std::size_t>(std::countr_zero(eight ^ same)) / 8;
  }
  while (at < column.size() && column[at] == column[begin]) ++at;
  return at;
}

// Canonical runs, bottom up: neighbours differ, uncovered levels are air, the last run is not air.
class RunList {
 public:
  void clear() { runs_.clear(); }
  std::span<const Run> runs() const { return runs_; }
  int height() const { return runs_.empty() ? 0 : runs_.back().top; }

  // Appends [height(), top) of a material, joined with an equal run below. Does nothing when top ≤ height().
  void add(int top, Material material) {
    if (top <= height()) return;
    if (!runs_.empty() && runs_.back().material == material) {
      runs_.back().top = static_cast<std::uint16_t>(top);
    } else {
      runs_.push_back({static_cast<std::uint16_t>(height()), static_cast<std::uint16_t>(top), material});
    }
  }
  void drop_trailing_air() {
    if (!runs_.empty() && runs_.back().material == Material::kAir) runs_.pop_back();
  }

  void encode(std::span<const Material> column) {
    clear();
    for (std::size_t begin = 0, end = 0; begin < column.size(); begin = end) {
      end = run_end(column, begin);
      add(static_cast<int>(end), column[begin]);
    }
    drop_trailing_air();
  }
  // Becomes `from` with levels [bottom, top) of `material`; `from` must not be this list's own runs.
  void edit(std::span<const Run> from, int bottom, int top, Material material) {
    clear();
    for (const Run& run : from) add(run.top < bottom ? run.top : bottom, run.material);
    add(bottom, Material::kAir);
    add(top, material);
    for (const Run& run : from) add(run.top, run.material);
    drop_trailing_air();
  }

 private:
  std::vector<Run> runs_;
};

}  // namespace terrabench
