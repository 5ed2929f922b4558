// The file of visibility changes (MRBSP paper, §4 and table 1): one line a step between neighbouring cells in
// which something changes, with the coarse triangles' hierarchical numbers. Finer changes are not stored:
// they are the subtrees.
//
//   terrabench-visibility 1
//   cells 8 1              columns and rows
//   side 2                 samples along a cell
//   depth 2                of the coarse triangles: digits a number
//   eye-height 0           metres
//   surface 0123…          what it was computed for: surface_checksum()
//   start 00, 01, 11       what the first cell sees
//   a-b 11                 what toggles from a to its right neighbour b
//   d-e 00, 01, 10, 11
//
// Cells are named by column, a … z, aa …, and, when there is more than one row, row: c4-d4 goes right, c4-c5
// down. The binary form holds the same with numbers as differences in base 128 and a checksum at the end.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lod/mrbsp/visibility.h"
#include "terrain/files.h"

namespace terrabench {

std::string cell_name(const CellGrid&, int column, int row);

std::string visibility_text(const VisibilityTable&);
// Throws bad_input with the line's number for anything that visibility_text() cannot have written, tables in
// which going around a corner of cells does not end where it began included.
VisibilityTable parse_visibility(std::string_view text, const std::string& origin);

void save_visibility(const VisibilityTable&, ByteSink&);
// Throws bad_input likewise. Needs memory in proportion to the file and the number of cells (2^20 at most).
VisibilityTable load_visibility(std::span<const std::byte>, const std::string& origin);

// Either form: by name, .txt is text. Written whole or not at all.
void write_visibility(const std::filesystem::path&, const VisibilityTable&);
VisibilityTable read_visibility(const std::filesystem::path&);

// What the binary form takes (headers and checksums apart), and what a set for each cell would: as a list of
// numbers in the same coding, and as a bit a triangle.
struct VisibilityBytes {
  std::size_t changes = 0, lists = 0, bits = 0;
};
VisibilityBytes visibility_bytes(const VisibilityTable&);

// The third column of table 1: the triangles of a finer depth that a coarse one holds, "1100, 1101, 1110,
// 1111".
std::string fine_changes(std::span<const std::uint32_t> elements, int coarse_depth, int fine_depth);

}  // namespace terrabench
