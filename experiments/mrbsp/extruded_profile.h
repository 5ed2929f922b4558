// The two-dimensional scene of the paper's figure 2 and table 1, extruded into a strip of ground one cell
// wide, so that the code that finds the visibility of a landscape (lod/mrbsp/visibility/) applies to it.
// Lines of sight along the strip are those of the profile.
//
// The paper prints no heights. From the table and its text: sixteen fine segments (four-digit numbers), four
// coarse ones (two-digit numbers), cells a to h, an observer at height zero. Cells up to d see only 00 and
// 01, those from e on only 10 and 11, so a ridge separates d from e; but a also sees 11 over it, and h sees
// 00, so the rims are higher. Our choice: cells of two fine segments each, and all heights.
//
// A segment is a square of the strip: the two triangles of a coarse segment, which must change together, or
// the finest triangles in it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lod/mrbsp/visibility/change_table.h"
#include "terrain/heightfield.h"
#include "terrain/progress.h"

namespace terrabench::mrbsp {

inline constexpr int kFineDigits = 4, kCoarseDigits = 2, kProfileCells = 8;

// 2^kFineDigits + 1 heights in metres, one metre apart.
std::span<const float> table1_profile();
Heightfield extrude(std::span<const float> profile);

// Changes in visibility for eyes on the ground, by triangles as long as the coarse segments.
visibility::ChangeTable find_changes(const Heightfield& strip, visibility::Mode, Progress&);

// The segments whose visibility changes from one cell to the next, ascending.
struct ProfileStep {
  std::vector<std::uint32_t> coarse;  // in the table
  std::vector<std::uint32_t> fine;    // in what Mrbsp draws at its finest from the middles of both cells
  bool whole = true;                  // both triangles of every coarse segment change
};
std::vector<ProfileStep> profile_steps(const Heightfield& strip, const visibility::ChangeTable&, Progress&);

// A row of table 1 as printed.
struct PrintedStep {
  std::string_view name, coarse, fine;
};
std::span<const PrintedStep> table1();
// Number of steps that are not as in the table. Steps that it does not list must change nothing.
int lines_unlike_table1(std::span<const ProfileStep>);

// "00, 01" for segments 0 and 1 of two digits; "d-e" for the step from the fourth cell.
std::string segment_labels(std::span<const std::uint32_t> segments, int digits);
std::string step_name(std::size_t step);

}  // namespace terrabench::mrbsp
