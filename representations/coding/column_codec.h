// Columns of material runs as bytes: the topmost ends as heights (height_codec.h), then each column's count
// of runs, materials and inner ends as differences from the columns to the west and north. Stacks and voxels
// hold the same columns, so that their files are the same. Columns without caves take two bits beside their
// height.
#pragma once

#include <vector>

#include "representations/column_grid.h"
#include "representations/runs.h"
#include "terrain/files.h"

namespace terrabench {

// The columns of the grid in rows: column c has runs [first[c], first[c + 1]), canonical as in RunList.
struct ColumnsOfRuns {
  std::vector<Run> runs;
  std::vector<std::uint32_t> first{0};

  std::span<const Run> column(std::size_t c) const {
    return std::span(runs).subspan(first[c], first[c + 1] - first[c]);
  }
  bool operator==(const ColumnsOfRuns&) const = default;
};
// Of a structure on this lattice, by its spans. O(columns + runs).
ColumnsOfRuns columns_of(const Representation&, const ColumnGrid&);

// Fills an empty structure on this lattice by its edit().
void fill(Representation&, const ColumnGrid&, const ColumnsOfRuns&);

// O(columns + runs), about 0.2 µs each.
void encode_columns(const ColumnGrid&, const ColumnsOfRuns&, ByteSink&);
// Throws bad_input for bytes that encode_columns() cannot have written.
ColumnsOfRuns decode_columns(ByteSource&, ColumnGrid& grid);

}  // namespace terrabench
