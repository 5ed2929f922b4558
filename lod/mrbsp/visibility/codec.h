// Change tables as text, as bytes and as files.
//
// Text has the form of the MRBSP paper's table 1 (§4): one line per step between neighbouring cells at which
// something changes, with the hierarchical numbers of the coarse triangles. Changes of finer triangles are
// not stored: they are the subtrees.
//
//   terrabench-visibility 3
//   cells 8 1              columns and rows
//   side 2                 samples along the side of a cell
//   depth 2                of the coarse triangles: digits per number
//   eye-height 0           metres
//   surface 0123…          the ground it was computed for: ground_checksum()
//   sets sampled           or another of kModeNames
//   start 00, 01, 11       the set of the first cell
//   a-b 11                 toggled between a and its right neighbour b
//   d-e 00, 01, 10, 11
//
// A cell is named by its column, a … z, aa …, followed by its row if there are several rows: c4-d4 is a step
// to the right, c4-c5 a step down.
//
// The binary form holds the same data: element numbers as differences in base 128, with a checksum at the
// end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "lod/mrbsp/visibility/change_table.h"
#include "terrain/files.h"

namespace terrabench::mrbsp::visibility {

std::string cell_name(const CellGrid&, glm::ivec2 cell);

// Decoding throws bad_input, with the line number or byte offset, for anything that encoding cannot have
// written, such as steps around a corner of four cells that do not cancel out. Its memory is proportional to
// the input and the number of cells (at most 2^20). `origin` names the input in errors.
std::string encode_text(const ChangeTable&);
ChangeTable decode_text(std::string_view text, const std::string& origin);
void encode_binary(const ChangeTable&, ByteSink&);
ChangeTable decode_binary(std::span<const std::byte>, const std::string& origin);

// Files hold text if the name ends in .txt, else bytes. Saving writes the whole file or nothing; it throws
// usage_error for text beyond 1 GiB, which load_file() would refuse.
void save_file(const std::filesystem::path&, const ChangeTable&);
ChangeTable load_file(const std::filesystem::path&);

// Loads the file; if there is none, computes the table with find_sets() and saves it. Throws usage_error for
// a file of other ground, another depth or other options (except the number of eyes, which files do not
// hold), and environment_error, before any work, if the folder does not exist.
ChangeTable load_or_find(const std::filesystem::path&, const GroundGrid&, const BisectionTree&,
                         const Options&, Progress&);

// Bytes of the binary form without header and checksum, and of two other codings: the set of each cell as a
// list of numbers in the same coding, and as one bit per coarse triangle.
struct EncodedSizes {
  std::size_t changes = 0, lists = 0, bits = 0;
};
EncodedSizes encoded_sizes(const ChangeTable&);

}  // namespace terrabench::mrbsp::visibility
