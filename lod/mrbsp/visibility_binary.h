// Visibility changes in bytes: what visibility_text.h has, with numbers as differences in base 128 and a
// checksum at the end.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lod/mrbsp/visibility_table.h"
#include "terrain/files.h"

namespace terrabench {

void save_visibility(const VisibilityTable&, ByteSink&);
// Throws bad_input for anything that save_visibility() cannot have written. Needs memory in proportion to the
// file and the number of cells (2^20 at most).
VisibilityTable load_visibility(std::span<const std::byte>, const std::string& origin);

// What the binary form takes (headers and checksums apart), and what a set for each cell would: as a list of
// numbers in the same coding, and as a bit a triangle.
struct VisibilityBytes {
  std::size_t changes = 0, lists = 0, bits = 0;
};
VisibilityBytes visibility_bytes(const VisibilityTable&);

}  // namespace terrabench
