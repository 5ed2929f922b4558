// The two-dimensional scene of the paper's figure 2 and table 1 as land, so that the code that finds what a
// landscape shows (lod/mrbsp/visibility/) finds it here too: a profile drawn out sideways into a strip one
// cell across. Every line of sight over it rises and falls as one in the profile does.
//
// The figure is not printed in numbers. Read off the table and its text: sixteen fine segments (numbers of
// four digits), four coarse ones (two digits), cells a to h, an observer at height zero; that only 00 and 01
// are seen up to d, and only 10 and 11 from e on, so that a ridge parts d from e; and that a sees 11, and h
// sees 00, over it, so that the rims are higher. Chosen: cells of two fine segments each, and all heights.
//
// A segment is a square of the strip: the two triangles of a coarse one, which must change together, and all
// of the finest triangles under these.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/mrbsp/visibility/change_table.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench::mrbsp {

inline constexpr int kFineDigits = 4, kCoarseDigits = 2, kProfileCells = 8;

// 2^kFineDigits + 1 heights in metres, a metre apart.
std::span<const float> table1_profile();
Heightfield extrude(std::span<const float> profile);

// Eyes on the ground; triangles of visibility as long as the coarse segments.
visibility::ChangeTable find_changes(const Heightfield& strip, bool conservative, Progress&);

// What changes from one cell to the next: segments, rising.
struct ProfileStep {
  std::vector<std::uint32_t> coarse;  // as stored
  std::vector<std::uint32_t> fine;    // as drawn: by Mrbsp at its finest, from the middles of both cells
  bool whole = true;                  // both triangles of every coarse segment
};
std::vector<ProfileStep> profile_steps(const Heightfield& strip, const visibility::ChangeTable&, Progress&);

}  // namespace terrabench::mrbsp
