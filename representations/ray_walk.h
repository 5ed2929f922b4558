// The walk of ray_cast.h: a ray over a grid of columns in plan.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "terrain/memory.h"
#include "terrain/solid.h"

namespace terrabench {

// Cells between vertical planes along one axis: plane k stands at origin + k · cell, but the first and the
// last at the bounds.
struct PlanAxis {
  double origin = 0, cell = 1, low = 0, high = 1;
  int cells = 1;
  double per_cell = 1 / cell;

  double plane(int k) const { return k <= 0 ? low : k >= cells ? high : origin + k * cell; }
  int cell_at(double x) const {
    return static_cast<int>(std::clamp((x - origin) * per_cell, 0.0, static_cast<double>(cells - 1)));
  }
};

// The highest solid point of each square of 4^l × 4^l cells, l ≥ 1; -∞ where nothing is solid. Level 0 is the
// ground's own. Squares of 2^l would be skipped earlier, but each level costs a branch that no predictor
// foresees.
class TopPyramid {
 public:
  static constexpr int kShift = 2, kSide = 1 << kShift;

  // top(i, j): of a cell. O(cells)
  template <class Top>
  TopPyramid(int width, int depth, const Top& top) {
    const int side = std::max(width, depth);
    levels_ = (std::bit_width(static_cast<unsigned>(side - 1)) + kShift - 1) / kShift;
    starts_.assign(2, 0);
    widths_.assign(1, width);
    for (int level = 1, w = width, d = depth; level <= levels_; ++level) {
      const int below_w = w, below_d = d;
      w = (w + kSide - 1) / kSide;
      d = (d + kSide - 1) / kSide;
      widths_.push_back(w);
      for (int j = 0; j < d; ++j) {
        for (int i = 0; i < w; ++i) {
          float highest = -std::numeric_limits<float>::infinity();
          for (int b = kSide * j; b < std::min(kSide * (j + 1), below_d); ++b) {
            for (int a = kSide * i; a < std::min(kSide * (i + 1), below_w); ++a) {
              highest = std::max(highest, level == 1 ? top(a, b) : at(level - 1, a, b));
            }
          }
          tops_.push_back(highest);
        }
      }
      starts_.push_back(tops_.size());
    }
    tops_.shrink_to_fit();
  }

  int levels() const { return levels_; }
  float at(int level, int i, int j) const {
    return tops_[starts_[level] + static_cast<std::size_t>(j) * widths_[level] + i];
  }
  std::size_t bytes() const {
    return heap_bytes(tops_.data()) + heap_bytes(starts_.data()) + heap_bytes(widths_.data());
  }

 private:
  int levels_ = 0;
  std::vector<std::size_t> starts_;  // of each level
  std::vector<int> widths_;
  std::vector<float> tops_;
};

// Positions along a ray.
struct RayPath {
  glm::dvec3 origin, direction;
  explicit RayPath(const Ray& ray) : origin(ray.origin), direction(ray.direction) {}
  double x(double t) const { return origin.x + t * direction.x; }
  double y(double t) const { return origin.y + t * direction.y; }
  double z(double t) const { return origin.z + t * direction.z; }
};

struct Stretch {
  double begin, end;  // of a ray, in lengths of its direction
};

// NaN compares false throughout. The same limits as of the rays of renderers/raytrace.
inline bool castable(const Ray& ray) {
  constexpr float kFarthest = 1e18F;
  const auto usable = [](const glm::vec3& v) {
    return std::abs(v.x) < kFarthest && std::abs(v.y) < kFarthest && std::abs(v.z) < kFarthest;
  };
  return usable(ray.origin) && usable(ray.direction) && ray.direction != glm::vec3(0) && ray.near >= 0 &&
         ray.far >= ray.near;
}

// Cuts the stretch to where low ≤ origin + t · direction ≤ high. False if nothing is left.
inline bool clip(double origin, double direction, double low, double high, Stretch& at) {
  if (direction == 0) return origin >= low && origin <= high;
  double a = (low - origin) / direction, b = (high - origin) / direction;
  if (a > b) std::swap(a, b);
  at.begin = std::max(at.begin, a);
  at.end = std::min(at.end, b);
  return at.begin <= at.end;
}

// Ground has
//   PlanAxis x, z; double floor, highest;        the box that contains all that is solid
//   TopPyramid tops;
//   bool solid(i, j, path, t);                   whether the ray is in the solid at t, as cell (i, j) says
//   double change(i, j, path, stretch, lowest, inside);  where it first is not as `inside` says, or infinity;
//                                                `lowest`: the ray's least height on the stretch
// A ground that is not const is one ray's own, and may remember what it found on earlier stretches.
template <class Ground>
class RayWalk {
 public:
  RayWalk(Ground& ground, const Ray& ray) : ground_(ground), path_(ray), ray_(ray) {}

  // Infinity for no hit.
  double closest() {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (!castable(ray_)) return kNone;
    Stretch box{ray_.near, ray_.far};
    const glm::dvec3 &o = path_.origin, &d = path_.direction;
    if (!clip(o.x, d.x, ground_.x.low, ground_.x.high, box) ||
        !clip(o.z, d.z, ground_.z.low, ground_.z.high, box) ||
        !clip(o.y, d.y, ground_.floor, ground_.highest, box)) {
      return kNone;
    }
    begin_ = box.begin;
    end_ = box.end;
    i_ = ground_.x.cell_at(path_.x(begin_));
    j_ = ground_.z.cell_at(path_.z(begin_));
    inside_ = ground_.solid(i_, j_, path_, begin_);
    if (inside_ && begin_ > ray_.near) return begin_;  // through a wall or the floor
    const double hit = walk();
    if (hit < kNone) return hit;
    return inside_ && end_ < ray_.far ? end_ : kNone;
  }

 private:
  double walk() {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const double per_x = 1 / path_.direction.x, per_z = 1 / path_.direction.z;
    int level = ground_.tops.levels() / 2;  // a guess, from which a ray in open air climbs
    double t = begin_, y = path_.y(t);
    for (;;) {
      const int shift = level * TopPyramid::kShift;
      const double to_x = leaves(ground_.x, i_ >> shift, shift, path_.origin.x, path_.direction.x, per_x);
      const double to_z = leaves(ground_.z, j_ >> shift, shift, path_.origin.z, path_.direction.z, per_z);
      const double end = std::max(t, std::min({to_x, to_z, end_}));
      const double end_y = path_.y(end), lowest = std::min(y, end_y);
      if (level == 0) {
        const double hit = ground_.change(i_, j_, path_, Stretch{t, end}, lowest, inside_);
        if (hit < kNone) return hit;
      } else if (inside_ || !(lowest > ground_.tops.at(level, i_ >> shift, j_ >> shift))) {
        --level;
        continue;
      }
      if (end >= end_) return kNone;
      t = end;
      y = end_y;
      const bool climbs = to_x <= to_z ? next(i_, path_.direction.x, shift, ground_.z, j_, path_.z(t))
                                       : next(j_, path_.direction.z, shift, ground_.x, i_, path_.x(t));
      if (i_ < 0 || j_ < 0 || i_ >= ground_.x.cells || j_ >= ground_.z.cells) return kNone;
      if (climbs && level < ground_.tops.levels()) ++level;
    }
  }

  // Where the ray passes the far side of a block of 2^shift cells.
  static double leaves(const PlanAxis& axis, int block, int shift, double origin, double direction,
                       double per) {
    if (direction == 0) return std::numeric_limits<double>::infinity();
    return (axis.plane((direction > 0 ? block + 1 : block) << shift) - origin) * per;
  }

  // Steps to the next block along one axis, and finds the cell along the other, within the same block.
  // Whether the next block is in another block of the level above.
  static bool next(int& cell, double direction, int shift, const PlanAxis& other, int& other_cell,
                   double at) {
    const int block = cell >> shift, other_block = other_cell >> shift;
    cell = direction > 0 ? (block + 1) << shift : (block << shift) - 1;
    if (shift > 0) {
      other_cell = std::clamp(other.cell_at(at), other_block << shift, ((other_block + 1) << shift) - 1);
    }
    return (block ^ (cell >> shift)) >> TopPyramid::kShift != 0;
  }

  Ground& ground_;
  RayPath path_;
  const Ray& ray_;
  double begin_ = 0, end_ = 0;
  int i_ = 0, j_ = 0;
  bool inside_ = false;
};

}  // namespace terrabench
