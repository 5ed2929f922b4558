// A level-of-detail method from outside: right triangles, bisected at the middle of their longest side where
// a bound of the error on the screen asks for it (Lindstrom & Pascucci 2001). A vertex's bound is at least
// that of every vertex below it, so that no triangle's neighbour is bisected alone and no crack opens. The
// whole mesh is chosen anew in every frame: O(triangles drawn). An edit costs O(samples).
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/lod.h"
#include "terrain/frustum.h"

namespace own {

using namespace terrabench;

class RightTriangles final : public Lod {
 public:
  static std::unique_ptr<Lod> build(const LodGround& ground, const Parameters&, Progress&) {
    check_ground(ground.heights);
    return std::make_unique<RightTriangles>(ground.heights);
  }
  static Knob knob() { return {"error", "px", 0.01, 1000, 1}; }

  explicit RightTriangles(const Heightfield& ground) : grid_(grid_of(ground)) {
    while (side_ < std::max(grid_.width, grid_.depth) - 1) side_ *= 2;
    measure();
  }
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  void edited(const SampleRect& rect) override {
    check_edit(rect, grid_.width, grid_.depth);
    measure();
    if (!first_) append_heights(grid_, rect, edits_);
  }
  Memory memory() const override {
    Memory all = payload_memory(splits_);
    all += {.index = heap_bytes(this)};
    return all += index_memory(indices_, drawn_, batches_, uploads_, edits_);
  }
  const Frame& update(const View& view) override {
    using Target = DirtyRange::Target;
    check_view(view);
    const Frustum frustum(view);
    const double scale = view.height / (2 * std::tan(view.vertical_fov / 2.0)) / pixels_;
    indices_.clear();
    refine({0, 0}, {side_, side_}, {side_, 0}, frustum, view.eye, scale);
    refine({side_, side_}, {0, 0}, {0, side_}, frustum, view.eye, scale);
    const auto corners = static_cast<std::uint32_t>(indices_.size());
    batches_.assign(corners > 0 ? 1 : 0, {0, corners});
    uploads_.assign(edits_.begin(), edits_.end());
    edits_.clear();
    if (indices_ != drawn_) uploads_.push_back({.target = Target::kIndices, .count = corners});
    if (first_)
      uploads_.push_back({.target = Target::kHeights, .count = std::uint32_t(grid_.heights.size())});
    first_ = false;
    drawn_ = indices_;
    frame_ = {.grid = grid_,
              .cell_x = grid_.cell_x,
              .cell_z = grid_.cell_z,
              .indices = drawn_,
              .batches = batches_,
              .uploads = uploads_,
              .stats = count(batches_, uploads_, 0)};
    return frame_;
  }

 private:
  using At = glm::ivec2;  // a vertex of the square of side_ cells that holds the ground
  // Of the two triangles whose longest sides meet at the vertex, and of all below them.
  struct Split {
    float error = 0;   // metres; infinite where they cross the ground's border
    float radius = 0;  // of a sphere around the vertex that contains them, metres
  };

  bool inside(At v) const { return v.x < grid_.width && v.y < grid_.depth; }
  bool in_square(At v) const { return v.x >= 0 && v.y >= 0 && v.x <= side_ && v.y <= side_; }
  std::size_t index(At v) const { return std::size_t(v.y) * (side_ + 1) + v.x; }
  std::uint32_t vertex(At v) const { return std::uint32_t(v.y) * grid_.width + v.x; }
  float height(At v) const { return grid_.heights[vertex(v)]; }
  glm::dvec3 place(At v) const { return {v.x * grid_.cell_x, height(v), v.y * grid_.cell_z}; }

  // Finest vertices first: the middles of sides 2·s long, then those of squares.
  void measure() {
    splits_.assign(std::size_t(side_ + 1) * (side_ + 1), {});
    for (int s = 1; s < side_; s *= 2) {
      for (int j = 0; j <= side_; j += s) {
        for (int i = j / s % 2 == 0 ? s : 0; i <= side_; i += 2 * s) {
          const At along = j / s % 2 == 0 ? At(s, 0) : At(0, s);
          measure({i, j}, along, {along.y, along.x}, {s / 2, s / 2}, {s / 2, -s / 2}, s);
        }
      }
      for (int j = s; j < side_; j += 2 * s) {
        for (int i = s; i < side_; i += 2 * s) {
          const At along(s, (i / (2 * s) + j / (2 * s)) % 2 == 0 ? s : -s);
          measure({i, j}, along, {along.x, -along.y}, {s, 0}, {0, s}, s);
        }
      }
    }
  }
  // The longest side ends at v ± along, the triangles' right angles lie at v ± across, and the vertices below
  // at v ± c and v ± d. All lie within `reach` samples.
  void measure(At v, At along, At across, At c, At d, int reach) {
    Split& split = splits_[index(v)];
    const At low = v - reach, high = glm::min(v + reach, At(side_));
    if (low.x >= grid_.width - 1 || low.y >= grid_.depth - 1) return;  // beyond the ground
    if (!inside(high)) {
      split.error = std::numeric_limits<float>::infinity();
      return;
    }
    split.error = std::abs(height(v) - 0.5F * (height(v - along) + height(v + along)));
    double radius = 0;
    for (const At corner : {v + along, v - along, v + across, v - across})
      if (in_square(corner)) radius = std::max(radius, glm::distance(place(v), place(corner)));
    for (const At below : {v + c, v - c, v + d, v - d}) {
      if (!in_square(below) || below == v) continue;
      const Split& other = splits_[index(below)];
      split.error = std::max(split.error, other.error);
      radius = std::max(radius, glm::distance(place(v), place(below)) + other.radius);
    }
    split.radius = static_cast<float>(radius * (1 + 1e-6));  // never rounded below a sphere inside
  }

  // The triangle with the longest side a–b, counter-clockwise from above.
  void refine(At a, At b, At apex, const Frustum& frustum, glm::dvec3 eye, double scale) {
    const At low = glm::min(glm::min(a, b), apex), size = glm::max(glm::max(a, b), apex) - low;
    if (low.x >= grid_.width - 1 || low.y >= grid_.depth - 1) return;
    if (size != At(1)) {
      const At middle = (a + b) / 2;
      const Split& split = splits_[index(middle)];
      bool bisect = std::isinf(split.error);
      if (!bisect) {
        const glm::vec3 at = place(middle);
        if (frustum.see({at - split.radius, at + split.radius}) == Sight::kOutside) return;
        bisect = split.error * scale > glm::distance(place(middle), eye) - split.radius;
      }
      if (bisect) {
        refine(apex, a, middle, frustum, eye, scale);
        refine(b, apex, middle, frustum, eye, scale);
        return;
      }
    }
    for (const At corner : {a, b, apex}) indices_.push_back(vertex(corner));
  }

  GroundGrid grid_;
  int side_ = 1;
  double pixels_ = knob().fallback;
  std::vector<Split> splits_;
  std::vector<std::uint32_t> indices_, drawn_;  // drawn_: of the last frame
  std::vector<Batch> batches_;
  std::vector<DirtyRange> uploads_, edits_;
  Frame frame_;
  bool first_ = true;
};

}  // namespace own
