// For every lattice point, the error of the two triangles that it splits and a sphere around it that holds
// them, both nested: they contain those of the points that depend on it (Lindstrom and Pascucci 2002, §3). So
// a test that grows with the error and with the sphere splits every point before its dependents, and the
// triangles conform without forced splits.
//
// The error is exact by default: the largest distance of any sample under one of the triangles from its
// plane. The published one is the distance of the middle sample alone. Building is O(points · log points) for
// exact errors, O(points) for published ones, level by level and in parallel; 8 bytes per point and 1/8 byte.
#pragma once

#include <cstddef>
#include <vector>

#include "lod/rtin/lattice.h"
#include "terrain/frame.h"
#include "terrain/memory.h"
#include "terrain/progress.h"
#include "terrain/solid.h"

namespace terrabench::rtin {

struct Nested {
  float error = 0, radius = 0;  // metres
};

class NestedErrors {
 public:
  NestedErrors(const GroundGrid&, bool exact, Progress&);

  // The heights at samples low … high have changed. O(samples changed · log samples), and for exact errors
  // also the samples under all triangles that contain a changed one: at most about three times the ground's.
  void update(glm::ivec2 low, glm::ivec2 high);

  const Lattice& lattice() const { return lattice_; }
  const Nested& at(glm::ivec2 point) const { return nested_[place(point)]; }
  // Where the point's sample lies, metres: in plan, and in space.
  glm::vec2 plan(glm::ivec2 point) const {
    return glm::vec2(lattice_.sample(point)) * glm::vec2(grid_.cell_x, grid_.cell_z);
  }
  glm::dvec3 position(glm::ivec2 point) const {
    const glm::vec2 at = plan(point);
    return {at.x, grid_.heights[lattice_.vertex(point)], at.y};
  }
  // Around a triangle that splits() and the samples under it; halves' boxes lie in those of their triangle.
  Bounds box(const Triangle&) const;
  Memory memory() const { return index_memory(own_, nested_); }

 private:
  // From this step on, what a point's own triangles measure is kept for update().
  static constexpr int kKeptStep = 8;

  // Lattice points, both included.
  struct Range {
    glm::ivec2 low, high;
  };
  Range around(const Range&, int steps) const;
  void nest_level(int step, const Range& changed);
  void nest(glm::ivec2 point, int step, bool edge, const Range& changed);
  Nested measure(glm::ivec2 point, int step, bool edge) const;
  void add_triangle(const Triangle&, Nested&) const;
  bool inside(glm::ivec2 point) const {
    return point.x >= 0 && point.y >= 0 && point.x < size_.x && point.y < size_.y;
  }
  std::size_t place(glm::ivec2 point) const {
    return static_cast<std::size_t>(point.y) * size_.x + static_cast<std::size_t>(point.x);
  }
  Nested& own(glm::ivec2 point) {
    return own_[static_cast<std::size_t>(point.y / kKeptStep) * (size_.x / kKeptStep + 1) +
                static_cast<std::size_t>(point.x / kKeptStep)];
  }

  GroundGrid grid_;
  Lattice lattice_;
  glm::ivec2 size_;  // of the lattice
  bool exact_;
  std::vector<Nested> own_, nested_;
};

}  // namespace terrabench::rtin
