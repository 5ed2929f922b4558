// Sight over the coarse surface, corner by corner: the sampled visibility (MRBSP paper, §4; see
// visibility.h). O(squares crossed) a line.
#pragma once

#include <glm/vec3.hpp>

#include "lod/mrbsp/coarse_squares.h"
#include "lod/mrbsp/visibility.h"
#include "terrain/frame.h"

namespace terrabench {

// Positions here are (samples, metres, samples): x and z in samples of the grid.
class LineOfSight {
 public:
  // Both must outlive it.
  LineOfSight(const GroundGrid& ground, const CoarseSquares& squares) : ground_(ground), squares_(squares) {}

  // Of the surface of coarse triangles. Inside the field only.
  float height(float x, float z) const;
  // Does the coarse surface leave the way free between the two, ends apart? Grazing it is free.
  bool clear(const glm::vec3& from, const glm::vec3& to) const;
  // Adds what eyes in the cell see: eyes × eyes of them.
  void find(int cell, int eyes, VisibleSets& sets) const;

 private:
  // A square's corners at the border are drawn in to the field.
  struct Patch {
    glm::vec2 low, size;
    float y00, y10, y01, y11;  // heights at low and high x, z
    bool rising;
    float height(float u, float v) const;  // u, v in [0, 1]
  };
  float sample(int i, int j) const;
  Patch patch(glm::ivec2 square) const;
  glm::ivec2 square_at(float x, float z) const;
  void see_square(const Patch&, glm::ivec2 square, std::span<const glm::vec3> eyes, int cell,
                  VisibleSets& sets) const;

  const GroundGrid& ground_;
  const CoarseSquares& squares_;
};

}  // namespace terrabench
