// The volume of a sphere over the columns around its centre, as functions of height: the sphere kernel's
// table. The centre lies at one of kPhases × kPhases places within its column. The chords of
// 16 × 16 or more vertical lines per column are summed; all volumes are integers, and mirrored columns have
// equal ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/memory.h"

namespace terrabench {

class SphereChords {
 public:
  static constexpr int kPhases = 8, kSteps = 64;
  static constexpr double kMaxRadius = 16;  // columns; larger tables would take more than 20 MB

  SphereChords() = default;
  // Metres. O(columns · kPhases²)
  SphereChords(double radius, double cell_x, double cell_z);

  // Columns from the centre's own to the farthest one, along x and z.
  int reach_x() const { return reach_x_; }
  int reach_z() const { return reach_z_; }
  // kSteps + 1 volumes over the column at these offsets from the centre's column, |offset| ≤ reach: between
  // the centre's height and s/kSteps of the radius above it. The last is half of all volume over the column.
  std::span<const std::int32_t> column(int phase_x, int phase_z, int offset_x, int offset_z) const {
    const int set = phase_z * kPhases + phase_x;
    const int row = set * (2 * reach_z_ + 1) + offset_z + reach_z_;
    const int column = row * (2 * reach_x_ + 1) + offset_x + reach_x_;
    return std::span(volumes_).subspan(static_cast<std::size_t>(column) * (kSteps + 1), kSteps + 1);
  }
  // The volume of the sphere: twice the sum of all columns' last volumes.
  std::int64_t total(int phase_x, int phase_z) const {
    return totals_[static_cast<std::size_t>(phase_z * kPhases + phase_x)];
  }
  Memory memory() const { return index_memory(volumes_) += index_memory(totals_); }

 private:
  int reach_x_ = 0, reach_z_ = 0;
  std::vector<std::int32_t> volumes_;
  std::vector<std::int64_t> totals_;
};

}  // namespace terrabench
