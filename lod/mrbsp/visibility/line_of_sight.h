// Sampled visibility over the coarse surface (MRBSP paper, §4, "vertex-to-vertex sampling"): lines of sight
// from eyes in a cell to the corners of coarse triangles, blocked by the coarse surface. Ground that the
// coarse surface leaves out can be missed. The paper does not say more; this reading adds that
// - an eye stands the eye height above the ground or above the coarse surface, whichever is higher;
// - a triangle is visible only if it faces the eye that sees one of its corners: neighbours share corners, so
//   corners alone cannot give the paper's table 1;
// - a triangle under the cell is always visible.
// O(squares crossed) per line.
#pragma once

#include <glm/vec3.hpp>

#include "lod/mrbsp/visibility/coarse_squares.h"
#include "lod/mrbsp/visibility/sets.h"
#include "terrain/frame.h"

namespace terrabench::mrbsp::visibility {

// Positions are (samples, metres, samples): x and z count samples of the grid.
class LineOfSight {
 public:
  // Both must outlive it.
  LineOfSight(const GroundGrid& ground, const CoarseSquares& squares) : ground_(ground), squares_(squares) {}

  // Height of the coarse surface. The position must lie inside the field.
  float height(float x, float z) const;
  // Whether the coarse surface leaves the segment free, its ends excluded. Touching the surface does not
  // block.
  bool clear(const glm::vec3& from, const glm::vec3& to) const;
  // Adds the triangles visible from eyes_per_side² eyes in the cell.
  void find(int cell, int eyes_per_side, Sets& sets) const;

 private:
  // A coarse square with its corner heights, clamped to the field.
  struct Square {
    glm::vec2 low, size;
    float y00, y10, y01, y11;  // heights at low and high x, z
    bool rising;
    float height(float u, float v) const;  // u, v in [0, 1]
  };
  float sample(int i, int j) const;
  Square square(glm::ivec2 index) const;
  glm::ivec2 index_at(float x, float z) const;
  std::vector<glm::vec3> eyes_in(glm::ivec2 low, glm::ivec2 high, int eyes_per_side, float eye_height) const;
  void add_seen(const Square&, glm::ivec2 index, std::span<const glm::vec3> eyes, int cell, Sets& sets) const;

  const GroundGrid& ground_;
  const CoarseSquares& squares_;
};

}  // namespace terrabench::mrbsp::visibility
