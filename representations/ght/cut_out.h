// Cutting out the part of the surface that an event touches, the first step of an Edit. What the event may
// not change is refused: ground at the terrain's border, without data, that lies over itself, or at the mouth
// of a carving. O(squares and faces touched · log).
#pragma once

#include "representations/ght/edit.h"
#include "representations/ght/loops.h"

namespace terrabench::ght {

// A rectangle in plan in any direction: u0 ≤ u ≤ u1, d0 ≤ d ≤ d1 along and left of a line.
struct TurnedRectangle {
  events::Line line;
  double u0, u1, d0, d1;

  std::array<glm::dvec2, 4> corners() const;               // (x, z), counter-clockwise seen from above
  bool touches(std::array<glm::dvec2, 3> triangle) const;  // (x, z)
};

// A simple polygon in plan (x, z), and everything less than `margin` away from it.
struct WidenedPolygon {
  std::span<const glm::dvec2> polygon;
  double margin;

  std::span<const glm::dvec2> corners() const { return polygon; }
  bool touches(std::array<glm::dvec2, 3> triangle) const;
};

// By how much cuts are wider than the new heightmaps, in sample spacings, so that the ring has a width.
inline constexpr double kRingMargin = 0.1;

struct RemovedPart {
  std::vector<Square> squares;     // plain ones, ascending
  std::vector<FaceId> faces;       // ascending
  Loop loop;                       // the cells around it, counter-clockwise seen from above
  std::vector<CellId> superseded;  // the cells inside the loop, ascending
};

// Removes in the Edit what the shape touches, and a little more where that is not bounded by one simple loop.
// Refuses a part that has no such loop.
RemovedPart cut_out(Edit& edit, const TurnedRectangle& shape);
RemovedPart cut_out(Edit& edit, const WidenedPolygon& shape);

// Only refuses what cut_out() would not remove; changes nothing.
void check_ground(const Edit& edit, const TurnedRectangle& shape);

}  // namespace terrabench::ght
