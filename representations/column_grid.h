// The lattice to which stacks and voxels quantise space: vertical columns on a horizontal grid, cut into
// levels. A sample represents the cell around it, as the materials of "hybrid" §3.1.1 do.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "representations/representation.h"

namespace terrabench {

// Half-open range of levels.
struct LevelRange {
  int begin, end;
};

struct ColumnGrid {
  static constexpr int kMaxColumns = 1 << 16, kMaxLevels = 65535;

  int width = 1, depth = 1, levels = 1;             // columns along x and z, levels along y
  double origin_x = 0, origin_y = 0, origin_z = 0;  // lowest corner of cell (0, 0, 0), metres
  double cell_x = 1, step = 1, cell_z = 1;          // size of a cell, metres

  std::size_t columns() const { return static_cast<std::size_t>(width) * depth; }
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * width + i; }
  float edge_x(int i) const { return static_cast<float>(origin_x + i * cell_x); }
  float edge_y(int level) const { return static_cast<float>(origin_y + level * step); }
  float edge_z(int j) const { return static_cast<float>(origin_z + j * cell_z); }
  float centre_x(int i) const { return static_cast<float>(origin_x + (i + 0.5) * cell_x); }
  float centre_y(int level) const { return static_cast<float>(origin_y + (level + 0.5) * step); }
  float centre_z(int j) const { return static_cast<float>(origin_z + (j + 0.5) * cell_z); }
  Bounds bounds() const {
    return {{edge_x(0), edge_y(0), edge_z(0)}, {edge_x(width), edge_y(levels), edge_z(depth)}};
  }

  // The levels whose centres lie in [bottom, top) metres, clipped to the grid.
  LevelRange quantise(float bottom, float top) const;

  void save(ByteSink&) const;
  static ColumnGrid load(ByteSource&);
  bool operator==(const ColumnGrid&) const = default;
};

// Maps positions to columns and levels, for a batch of queries.
class ColumnLookup {
 public:
  explicit ColumnLookup(const ColumnGrid& grid)
      : grid_(grid),
        bounds_(grid.bounds()),
        per_x_(1 / grid.cell_x),
        per_y_(1 / grid.step),
        per_z_(1 / grid.cell_z) {}

  // False outside; the far border belongs to the last column.
  bool column(float x, float z, int& i, int& j) const {
    if (!(x >= bounds_.low.x && x <= bounds_.high.x && z >= bounds_.low.z && z <= bounds_.high.z))
      return false;
    i = clamp(static_cast<int>((x - grid_.origin_x) * per_x_), grid_.width);
    j = clamp(static_cast<int>((z - grid_.origin_z) * per_z_), grid_.depth);
    return true;
  }
  // The level with edge_y(level) ≤ y < edge_y(level + 1), exactly, so that materials() and spans() agree; -1
  // outside.
  int level(float y) const {
    if (!(y >= bounds_.low.y && y < bounds_.high.y)) return -1;
    const int guess = clamp(static_cast<int>((y - grid_.origin_y) * per_y_), grid_.levels);
    return guess - static_cast<int>(y < grid_.edge_y(guess)) + static_cast<int>(y >= grid_.edge_y(guess + 1));
  }

 private:
  static int clamp(int at, int size) { return at < 0 ? 0 : at < size ? at : size - 1; }

  ColumnGrid grid_;
  Bounds bounds_;
  double per_x_, per_y_, per_z_;
};

// Reads a source column by column on the grid that its parameters `resolution` and `step` ask for.
class ColumnSampler {
 public:
  // For heights and step 0 the step is the least power of two (metres) that gives at most `automatic_levels`.
  // Throws bad_input for a source without solid material, usage_error for a step that needs more than
  // kMaxLevels.
  ColumnSampler(const TerrainSource&, const Parameters&, int automatic_levels);

  const ColumnGrid& grid() const { return grid_; }
  bool from_heights() const { return heights_ != nullptr; }
  // The level of the ground in column (i, j); 0 without data. Heights only.
  int top(int i, int j) const;
  // All levels of column (i, j); `out` holds at least grid().levels. Thread-safe.
  void sample(int i, int j, std::span<Material> out) const;

 private:
  void choose_grid(const Solid&, const Parameters&);
  void choose_grid(const Heightfield&, double step, int automatic_levels);

  ColumnGrid grid_;
  const Solid* solid_ = nullptr;
  const Heightfield* heights_ = nullptr;
  std::optional<Heightfield> resampled_;
};

// `resolution` and `step`, common to all methods on this lattice.
std::span<const ParameterSpec> column_parameters();
std::vector<ParameterSpec> column_parameters_and(std::initializer_list<ParameterSpec> own);

// Columns along the longest side of a solid when `resolution` is 0.
inline constexpr int kDefaultResolution = 128;

// Throws bad_input unless every height is finite or no-data, at least one is a height, and sizes make sense.
void check_heights(const Heightfield&, std::string_view where);
// For surfaces between samples. Throws usage_error for a single row or column, which has none.
void require_cells(int width, int depth, std::string_view where);
// The field's rectangle with `resolution` samples along its longer side (resample_gridline()), where cells
// keep their shape as nearly as whole numbers allow; nothing when it has that many, or for 0. Throws
// usage_error for 1 sample.
std::optional<Heightfield> at_resolution(const Heightfield&, std::int64_t resolution);
// Throws usage_error unless there is one span per column, each with bottom < top (infinite ends are allowed).
void check_edit(Columns where, std::span<const Span> what);

}  // namespace terrabench
