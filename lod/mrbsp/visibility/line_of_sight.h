// Sampled visibility over the coarse surface (MRBSP paper, §4, "vertex-to-vertex sampling"): lines of sight
// from eyes in a cell to the vertices of the coarse triangles, blocked by the coarse surface. A triangle is
// visible if an eye sees one of its vertices. Ground that the coarse surface leaves out can be missed.
//
// Eyes (Mode in sets.h). The paper cuts the surface at eye height into rectangular cells and samples from
// vertex to vertex, so the eyes are a cell's vertices: its four corners, or all of its samples. Where the
// paper says nothing, we chose:
// - An eye stands the eye height above the ground or above the coarse surface, whichever is higher.
// - A corner belongs to up to four cells. Each cell's eye stands kInset inside it, or neighbouring cells
//   would share all that their common corners see, which the paper's table 1 contradicts (cells d and e).
// - A triangle under the cell is always visible.
// - With `facing`, a triangle must also face the eye that sees one of its vertices. The paper has no such
//   test, but its table 1 needs one: segments 01 and 10 share a vertex, which every eye over 01 sees.
// O(squares crossed) per line of sight.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "lod/mrbsp/visibility/coarse_squares.h"
#include "lod/mrbsp/visibility/sets.h"
#include "terrain/frame.h"

namespace terrabench::mrbsp::visibility {

enum class Eyes : std::uint8_t {
  kCorners,  // of the cell
  kSamples,  // all samples in the cell and on its border
  kInside,   // per_side² places, evenly spaced, none on the border
};
struct Sampling {
  Eyes eyes = Eyes::kCorners;
  bool facing = false;
  int per_side = 2;  // kInside only
};

// Positions are (samples, metres, samples): x and z count samples of the grid. 4 bytes per coarse vertex.
class LineOfSight {
 public:
  static constexpr float kInset = 1.0F / 256;  // samples

  // Both must outlive it.
  LineOfSight(const GroundGrid& ground, const CoarseSquares& squares);

  // Height of the coarse surface. The position must lie inside the field.
  float height(float x, float z) const;
  // Whether the coarse surface leaves the segment free, its ends excluded. Touching the surface does not
  // block.
  bool clear(const glm::vec3& from, const glm::vec3& to) const;
  // Adds the triangles visible from the cell's eyes: at most one line of sight per eye and coarse vertex.
  void find(int cell, const Sampling& sampling, Sets& sets) const;

 private:
  // A coarse square with its corner heights, clamped to the field.
  struct Square {
    glm::vec2 low, size;
    float y00, y10, y01, y11;  // heights at low and high x, z
    bool rising;
    float height(float u, float v) const;  // u, v in [0, 1]
  };
  struct CellArea {
    glm::ivec2 low, high;  // samples, both included
  };
  // What is known of the lines of sight from one eye, by coarse vertex.
  enum class Line : std::uint8_t { kUnknown, kClear, kBlocked };

  Square square(glm::ivec2 index) const;
  glm::ivec2 index_at(float x, float z) const;
  std::size_t vertex(glm::ivec2 at) const {
    return static_cast<std::size_t>(at.y) * (count_.x + 1) + static_cast<std::size_t>(at.x);
  }
  glm::vec3 vertex_position(glm::ivec2 at) const {
    return {along_x_[static_cast<std::size_t>(at.x)], heights_[vertex(at)],
            along_z_[static_cast<std::size_t>(at.y)]};
  }
  void add_under(const CellArea&, int cell, Sets& sets) const;
  void add_seen(const glm::vec3& eye, bool facing, int cell, std::vector<Line>& lines, Sets& sets) const;

  const GroundGrid& ground_;
  const CoarseSquares& squares_;
  glm::ivec2 count_;                      // squares along x and z that cover the field
  std::vector<float> along_x_, along_z_;  // positions of the coarse vertices; the last ones are the border's
  std::vector<float> heights_;            // of the coarse vertices, row by row
};

}  // namespace terrabench::mrbsp::visibility
