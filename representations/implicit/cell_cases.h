// How a surface passes through a cell whose corners are solid or air: the 256 cases of marching cubes
// (Lorensen & Cline 1987), derived instead of tabulated. On each face the contour separates solid corners
// that touch diagonally, a rule that depends on the face alone, so that neighbouring cells always agree
// (the cases of 1987 do not). The contours join to at most four loops of three to seven edges.
//
// Corner c lies at (c & 1, c >> 1 & 1, c >> 2); bit c of a case is set where it is solid. Edge 4·axis + o
// joins the corners at 0 and 1 along `axis`; bits 0 and 1 of o are its place along the two other axes, in
// the order x, y, z.
#pragma once

#include <array>
#include <cstdint>

namespace terrabench {

struct CellCase {
  std::uint8_t loops = 0, triangles = 0;
  // The loop that passes each edge; kNoLoop where the surface does not cross.
  std::array<std::uint8_t, 12> loop_of{};
  // Edges, three per triangle, counter-clockwise from the air. No two triangles of a loop share a line on a
  // face of the cell, so that no line of the whole surface belongs to more than two triangles.
  std::array<std::uint8_t, 15> corners{};
};
inline constexpr std::uint8_t kNoLoop = 255;

// By case. Computed at the first call.
const std::array<CellCase, 256>& cell_cases();

}  // namespace terrabench
