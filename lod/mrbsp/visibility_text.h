// Visibility changes as text, in the form of the MRBSP paper's table 1 (§4): one line a step between
// neighbouring cells in which something changes, with the coarse triangles' hierarchical numbers. Finer
// changes are not stored: they are the subtrees.
//
//   terrabench-visibility 2
//   cells 8 1              columns and rows
//   side 2                 samples along a cell
//   depth 2                of the coarse triangles: digits a number
//   eye-height 0           metres
//   surface 0123…          what it was computed for: surface_checksum()
//   sets sampled           or conservative
//   start 00, 01, 11       what the first cell sees
//   a-b 11                 what toggles from a to its right neighbour b
//   d-e 00, 01, 10, 11
//
// Cells are named by column, a … z, aa …, and, when there is more than one row, row: c4-d4 goes right, c4-c5
// down.
#pragma once

#include <string>
#include <string_view>

#include "lod/mrbsp/visibility_table.h"

namespace terrabench {

std::string cell_name(const CellGrid&, int column, int row);

std::string visibility_text(const VisibilityTable&);
// Throws bad_input with the line's number for anything that visibility_text() cannot have written, tables in
// which going around a corner of cells does not end where it began included.
VisibilityTable parse_visibility(std::string_view text, const std::string& origin);

}  // namespace terrabench
