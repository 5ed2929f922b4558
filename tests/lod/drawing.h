// Frames made by hand, and what the tests of meters and methods share.
#pragma once

#include <vector>

#include "terrain/frame.h"
#include "terrain/progress.h"
#include "terrain/view.h"
#include "tests/terrain/ground.h"

namespace terrabench::test {

inline Progress& silent() {
  static Progress progress;
  return progress;
}

// From high above the middle: the whole field is in view.
inline View from_above(const Heightfield& field) {
  View view;
  view.target = {0.5F * field.extent_x(), 0, 0.5F * field.extent_z()};
  view.eye = view.target + glm::vec3(0, 4 * (field.extent_x() + field.extent_z()) + 100, 0);
  view.up = {0, 0, -1};
  view.far = 10 * view.eye.y;
  return view;
}

// Of all triangles that the frame draws.
inline std::vector<glm::vec3> corners_of(const Frame& frame) {
  std::vector<glm::vec3> corners;
  triangles(frame, [&](std::span<const glm::vec3> some) {
    corners.insert(corners.end(), some.begin(), some.end());
  });
  return corners;
}

// The heights in all windows of a clipmap, n × n samples each, in lattice order.
inline std::vector<float> windows_of(const Frame& frame, int n) {
  std::vector<float> heights;
  for (const ClipLevel& level : frame.clip_levels) {
    const int mask = level.side - 1;
    for (int b = level.corner.y; b < level.corner.y + n; ++b) {
      for (int a = level.corner.x; a < level.corner.x + n; ++a)
        heights.push_back(level.heights[(b & mask) * level.side + (a & mask)]);
    }
  }
  return heights;
}

// Of a surface seen from above; what faces down counts negatively.
inline double plan_area(const std::vector<glm::vec3>& corners) {
  double area = 0;
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const glm::dvec3 u = corners[k + 1] - corners[k], v = corners[k + 2] - corners[k];
    area += 0.5 * (u.z * v.x - u.x * v.z);
  }
  return area;
}
inline double plan_area(const Frame& frame) { return plan_area(corners_of(frame)); }
inline double plan_area(const Heightfield& field) {
  return static_cast<double>(field.extent_x()) * field.extent_z();
}

// Builds a frame over a field triangle by triangle.
class Drawing {
 public:
  explicit Drawing(const Heightfield& field) : field_(field) { batches_.emplace_back(); }

  // Corners by sample. Counter-clockwise from above, z to the south.
  void triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
    for (const glm::ivec2 p : {a, b, c})
      indices_.push_back(static_cast<std::uint32_t>(p.y * field_.width + p.x));
    batches_.back().index_count += 3;
  }
  // A square of two triangles.
  void square(int i, int j, int side) {
    triangle({i, j}, {i, j + side}, {i + side, j});
    triangle({i + side, j}, {i, j + side}, {i + side, j + side});
  }
  // All squares of this side, row by row, but the one at `without`.
  void squares(int side, glm::ivec2 without = {-1, -1}) {
    for (int j = 0; j + side < field_.depth; j += side) {
      for (int i = 0; i + side < field_.width; i += side) {
        if (glm::ivec2(i, j) != without) square(i, j, side);
      }
    }
  }
  void batch(std::uint16_t level) {
    batches_.push_back({static_cast<std::uint32_t>(indices_.size()), 0, 0, level});
  }
  Frame frame() const {
    return {.grid = {field_.width, field_.depth, field_.cell_x, field_.cell_z, field_.heights},
            .cell_x = field_.cell_x,
            .cell_z = field_.cell_z,
            .indices = indices_,
            .batches = batches_,
            .uploads = {},
            .stats = count(batches_, {}, 0)};
  }

 private:
  const Heightfield& field_;
  std::vector<std::uint32_t> indices_;
  std::vector<Batch> batches_;
};

}  // namespace terrabench::test
