// Up to which distance from the eye each level of CDLOD is drawn, and where its vertices morph (Strugar
// 2009).
//
// Level l is drawn from end(l - 1) to end(l); its vertices morph from `from` = end(l - 1) + 0.66·(end(l) -
// end(l - 1)) on and have arrived at the surface of level l + 1 at `to`. The paper leaves it to the user to
// choose ranges that are large enough for the nodes; here ranges that are too small are enlarged. Why no
// seam can open:
//
// A quarter of a node of level m > l is drawn only where its box does not reach end(m - 1), so all its points
// are at end(m - 1) ≥ end(l) or farther. Let a node of level l be drawn beside it. Its box reaches end(l), so
// its points are nearer than end(l) + node(l), the diagonal of the largest box of level l. Since from(l + 1)
// ≥ end(l) + node(l), points of the side that they share are nearer than from(l + 1) < end(l + 1). Hence
// m = l + 1, and none of the vertices that the coarser node has there has begun to morph. The finer node has
// the same vertices there (MorphingNode). All vertices of its triangles at the side are at end(l) -
// triangle(l) or farther, where triangle(l) is the longest distance within a triangle of level l; since `to`
// ≤ this, they have arrived, and joining the side does not move the surface.
#pragma once

#include <span>

#include "terrain/frame.h"

namespace terrabench::cdlod {

// The share of a level's range, from the end of the finer one's, beyond which vertices morph.
inline constexpr double kMorphStart = 0.66;

// Metres.
struct LevelNeeds {
  double end = 0;       // the level is drawn up to here at least
  double from = 0;      // vertices do not morph before,
  double to = 0;        // and have not arrived before
  double node = 0;      // diagonal of the largest box of a node
  double triangle = 0;  // longest distance within a triangle
};

struct LevelRange {
  double end = 0;      // 0: the level is not drawn; infinite for the coarsest
  MorphRange morph{};  // of vertices
};

// For all levels, finest first. A level that needs no range, below which none does, is not drawn. O(levels).
void fit_ranges(std::span<const LevelNeeds>, std::span<LevelRange>);

}  // namespace terrabench::cdlod
