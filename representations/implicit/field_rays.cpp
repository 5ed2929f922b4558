#include "representations/implicit/field_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "representations/ray_walk.h"

namespace terrabench {
namespace {

constexpr double kNoHit = std::numeric_limits<double>::infinity();
constexpr float kEndless = std::numeric_limits<float>::infinity(), kNothing = -kEndless;

// Heights over a cell of the lattice in plan between which the surface can pass, metres.
struct HeightRange {
  float low, high;
};

// From a point of a cell to the nearest corner, along each axis, metres. The last cell can be a little
// larger.
double half_cell(const FieldLattice& lattice) { return 0.5005 * static_cast<double>(lattice.cell); }

// How much the field can differ between a point of a cell and the cell's nearest corner.
double within_cell(const StackField& field, const FieldLattice& lattice) {
  return field.steepest(glm::dvec3(half_cell(lattice))) + field.jump();
}

// How much closer to 0 the field can be at a point of a cell than at all four corners of its level.
double within_level(const StackField& field, const FieldLattice& lattice) {
  const auto positions = [&](int axis) {
    std::vector<float> all;
    for (int k = 0; k <= lattice.cells[axis]; ++k) all.push_back(lattice.position(axis, k));
    return all;
  };
  if (field.linear_between(positions(0), positions(2))) return field.jump();
  return field.steepest({half_cell(lattice), 0, half_cell(lattice)}) + field.jump();
}

// The ranges of a rectangle of columns, row by row.
struct RangeBlock {
  std::vector<std::uint32_t> counts;  // per column
  std::vector<HeightRange> ranges;
};

// Finds them from the lattice's samples, two planes at a time.
class RangeSweep {
 public:
  RangeSweep(const ImplicitSurface& of, const ColumnTops& tops, double margin, glm::ivec2 begin,
             glm::ivec2 end)
      : field_(of.field()),
        tops_(tops),
        lattice_(of.lattice()),
        begin_(begin),
        end_(end),
        margin_(static_cast<float>(margin)),
        per_change_(static_cast<float>(1 / of.field().steepest({0, 1, 0}))) {
    const auto levels = lattice_.levels(field_, begin, end);
    for (int i = begin.x; i <= end.x; ++i) xs_.push_back(lattice_.position(0, i));
    if (!levels || levels->first == levels->last) return;
    first_ = levels->first;
    for (int k = first_; k <= levels->last; ++k) ys_.push_back(lattice_.position(1, k));
    planes_ = field_.planes(xs_, ys_);
  }

  RangeBlock run() {
    const auto columns =
        static_cast<std::size_t>(end_.x - begin_.x) * static_cast<std::size_t>(end_.y - begin_.y);
    if (ys_.empty()) return {std::vector<std::uint32_t>(columns, 0), {}};
    values_.resize(xs_.size() * ys_.size());
    for (std::vector<Free>& plane : free_) plane.resize(values_.size());
    load(begin_.y, free_[0]);
    for (int j = begin_.y; j < end_.y; ++j) {
      load(j + 1, free_[1]);
      for (std::size_t i = 0; i + 1 < xs_.size(); ++i) add_column(i * ys_.size(), air_over(i, j));
      free_[0].swap(free_[1]);
    }
    return std::move(out_);
  }

 private:
  // The distance along y, metres, over which the cells around a point have its sign, if their other corners
  // have it too; at most to the next point. Positive in the solid, negative in air.
  struct Free {
    float down, up;
  };

  void load(int j, std::vector<Free>& free) {
    planes_->sample(lattice_.position(2, j), values_);
    for (std::size_t line = 0; line < values_.size(); line += ys_.size()) {
      for (std::size_t k = 0; k < ys_.size(); ++k) free[line + k] = {0, 0};
      for (std::size_t k = 0; k + 1 < ys_.size(); ++k) {
        const float apart = ys_[k + 1] - ys_[k], below = values_[line + k], above = values_[line + k + 1];
        float up = free_beside(below), down = free_beside(above);
        if ((below > 0) == (above > 0) && up + down >= apart) up = down = apart;
        free[line + k].up = std::copysign(std::min(up, apart), below);
        free[line + k + 1].down = std::copysign(std::min(down, apart), above);
      }
    }
  }
  float free_beside(float value) const { return std::max(0.0F, (std::abs(value) - margin_) * per_change_); }

  // Of the cells between the lines of points that begin at `at` and the next ones.
  void add_column(std::size_t at, double air) {
    const Free* const lines[] = {&free_[0][at], &free_[0][at + ys_.size()], &free_[1][at],
                                 &free_[1][at + ys_.size()]};
    const auto least = [&](std::size_t k, float Free::*side) {
      return std::min({lines[0][k].*side, lines[1][k].*side, lines[2][k].*side, lines[3][k].*side});
    };
    const auto most = [&](std::size_t k, float Free::*side) {
      return std::max({lines[0][k].*side, lines[1][k].*side, lines[2][k].*side, lines[3][k].*side});
    };
    const std::size_t before = out_.ranges.size();
    for (std::size_t k = 0; k + 1 < ys_.size() && ys_[k] < air; ++k) {
      const bool last = first_ + static_cast<int>(k) + 1 == lattice_.cells.y;  // the box's top: air above
      const float from_below = std::max({0.0F, least(k, &Free::up), -most(k, &Free::up)});
      const float in_solid = last ? 0.0F : least(k + 1, &Free::down);
      const float from_above = std::max({0.0F, in_solid, -most(k + 1, &Free::down)});
      if (!last && from_below + from_above >= ys_[k + 1] - ys_[k]) continue;
      const double low = ys_[k] + from_below, high = std::min<double>(ys_[k + 1] - from_above, air);
      if (low <= high) add_range(low, high, before);
    }
    out_.counts.push_back(static_cast<std::uint32_t>(out_.ranges.size() - before));
  }

  // To the column whose ranges begin at `before`. Wider by more than the rounding of both.
  void add_range(double low, double high, std::size_t before) {
    const HeightRange range{std::nextafter(static_cast<float>(low), -kEndless),
                            std::nextafter(static_cast<float>(high), kEndless)};
    if (out_.ranges.size() > before && out_.ranges.back().high >= range.low) {
      out_.ranges.back().high = range.high;
    } else {
      out_.ranges.push_back(range);
    }
  }
  double air_over(std::size_t i, int j) const {
    return field_.highest({xs_[i], lattice_.position(2, j)}, {xs_[i + 1], lattice_.position(2, j + 1)},
                          tops_);
  }

  const StackField& field_;
  const ColumnTops& tops_;
  const FieldLattice& lattice_;
  glm::ivec2 begin_, end_;     // cells along x and z
  float margin_, per_change_;  // the least |field| that proves a sign nearby; metres per unit of field
  int first_ = 0;              // point along y
  std::vector<float> xs_, ys_, values_;
  std::vector<Free> free_[2];  // of the planes at j and j + 1
  std::unique_ptr<FieldPlanes> planes_;
  RangeBlock out_;
};

struct FieldGround;

// What one ray knows: a Ground of ray_walk.h for it alone.
class FieldRay {
 public:
  FieldRay(const FieldGround& ground, const Ray& ray);

  bool solid(int i, int j, const RayPath& path, double t);
  double change(int i, int j, const RayPath& path, Stretch at, double lowest, bool inside);

 private:
  double value(const RayPath& path, double t) const;
  double change(const RayPath& path, Stretch at, bool inside);
  double narrow(const RayPath& path, double a, double b, double at_a, double at_b) const;

  const FieldGround& ground_;
  double per_change_, least_, fine_;  // in lengths of the direction
  // The position and value of the last sample, and the earliest position of the next one. The field keeps
  // its sign between the two unless they are at most least_ apart.
  double sampled_ = -kNoHit, value_ = 0, clear_ = -kNoHit;

 public:
  const PlanAxis &x, &z;
  double floor, highest;
  const TopPyramid& tops;
};

struct FieldGround {
  explicit FieldGround(const ImplicitSurface& of)
      : field(of.field()),
        lattice(of.lattice()),
        x(axis(0)),
        z(axis(2)),
        jump(field.jump()),
        columns(of.stack()),
        ranges(read(of)),
        tops(x.cells, z.cells, [&](int i, int j) { return top(i, j); }) {
    highest = tops.levels() == 0 ? top(0, 0) : tops.at(tops.levels(), 0, 0);
  }

  PlanAxis axis(int k) const {
    return {lattice.low[k], lattice.cell, lattice.low[k], lattice.high[k], lattice.cells[k]};
  }

  std::vector<HeightRange> read(const ImplicitSurface& of) {
    constexpr int kWidth = 32, kDepth = 128;  // cells of a block: its planes stay in a cache
    const int across = (x.cells + kWidth - 1) / kWidth, down = (z.cells + kDepth - 1) / kDepth;
    const double margin = within_level(of.field(), of.lattice());
    std::vector<RangeBlock> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
      const glm::ivec2 begin{static_cast<int>(b) % across * kWidth, static_cast<int>(b) / across * kDepth};
      blocks[b] = RangeSweep(of, columns, margin, begin,
                             glm::min(begin + glm::ivec2(kWidth, kDepth), {x.cells, z.cells}))
                      .run();
    });
    std::vector<HeightRange> all;
    std::size_t size = 0;
    for (const RangeBlock& block : blocks) size += block.ranges.size();
    all.reserve(size);
    starts.reserve(static_cast<std::size_t>(x.cells) * static_cast<std::size_t>(z.cells) + 1);
    starts.push_back(0);
    // Rows of the grid, each pieced together from the blocks that it passes.
    struct Place {
      std::size_t column = 0, range = 0;
    };
    std::vector<Place> places(blocks.size());
    for (int j = 0; j < z.cells; ++j) {
      for (int i = 0; i < x.cells; ++i) {
        const std::size_t b = static_cast<std::size_t>(j / kDepth * across + i / kWidth);
        const std::uint32_t count = blocks[b].counts[places[b].column++];
        for (std::uint32_t k = 0; k < count; ++k) all.push_back(blocks[b].ranges[places[b].range++]);
        starts.push_back(static_cast<std::uint32_t>(all.size()));
      }
    }
    return all;
  }

  std::span<const HeightRange> column(int i, int j) const {
    const std::size_t c =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(x.cells) + static_cast<std::size_t>(i);
    return {ranges.data() + starts[c], starts[c + 1] - starts[c]};
  }
  float top(int i, int j) const {
    const auto of = column(i, j);
    return of.empty() ? kNothing : of.back().high;
  }

  double closest(const Ray& ray) const {
    FieldRay one(*this, ray);
    return RayWalk(one, ray).closest();
  }
  std::size_t bytes() const {
    return tops.bytes() + columns.bytes() + heap_bytes(starts.data()) + heap_bytes(ranges.data());
  }

  const StackField& field;
  const FieldLattice& lattice;
  PlanAxis x, z;
  double jump, highest = 0;
  ColumnTops columns;
  std::vector<std::uint32_t> starts;  // the ranges of column c are [starts[c], starts[c + 1])
  std::vector<HeightRange> ranges;
  TopPyramid tops;
};

FieldRay::FieldRay(const FieldGround& ground, const Ray& ray)
    : ground_(ground),
      x(ground.x),
      z(ground.z),
      floor(static_cast<double>(ground.lattice.low.y)),
      highest(ground.highest),
      tops(ground.tops) {
  const glm::dvec3 direction(ray.direction);
  per_change_ = 1 / ground.field.steepest(direction);
  const double cell = static_cast<double>(ground.lattice.cell) / glm::length(direction);
  least_ = cell / 4;
  fine_ = cell / 1024;
}

double FieldRay::value(const RayPath& path, double t) const {
  return static_cast<double>(ground_.field.at({path.x(t), path.y(t), path.z(t)}, ground_.columns));
}

bool FieldRay::solid(int i, int j, const RayPath& path, double t) {
  if (path.y(t) > static_cast<double>(ground_.top(i, j))) return false;
  return value(path, t) > 0;
}

double FieldRay::change(int i, int j, const RayPath& path, Stretch at, double lowest, bool inside) {
  const auto ranges = ground_.column(i, j);
  if (ranges.empty() || (!inside && lowest > static_cast<double>(ground_.top(i, j)))) return kNoHit;
  const bool up = path.direction.y > 0;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const HeightRange range = ranges[up ? k : ranges.size() - 1 - k];
    Stretch part = at;
    if (!clip(path.origin.y, path.direction.y, range.low, range.high, part)) {
      continue;
    }
    const double hit = change(path, part, inside);
    if (hit < kNoHit) return hit;
  }
  return kNoHit;
}

double FieldRay::change(const RayPath& path, Stretch at, bool inside) {
  for (double t = std::max(at.begin, clear_); t <= at.end; t = clear_) {
    if (t > sampled_) {
      const double before = sampled_, at_before = value_;
      sampled_ = t;
      value_ = value(path, t);
      if ((value_ > 0) != inside) {
        return before < 0 ? t : narrow(path, before, t, at_before, value_);
      }
    }
    if (t == at.end) break;
    const double free = t + (std::abs(value_) - ground_.jump) * per_change_;
    clear_ = std::max({free, std::min(t + least_, at.end), std::nextafter(t, kNoHit)});
  }
  return kNoHit;
}

// Narrows down the change of sign between a and b to fine_, and returns the end on the side of b. Uses false
// position and halves the value at an end that is kept twice (the Illinois method); every fourth step is a
// bisection. No step lands within fine_ / 2 of an end, so that both ends close in.
double FieldRay::narrow(const RayPath& path, double a, double b, double at_a, double at_b) const {
  const bool begins = at_a > 0;
  int kept = 0;  // the end that the last step kept: -1 a, 1 b
  for (int step = 1; b - a > fine_; ++step) {
    double t = a + (b - a) * (at_a / (at_a - at_b));
    t = step % 4 == 0 ? (a + b) / 2 : std::clamp(t, a + fine_ / 2, b - fine_ / 2);
    if (t <= a || t >= b) break;  // so far away that no number lies between
    const double at_t = value(path, t);
    if ((at_t > 0) == begins) {
      a = t;
      at_a = at_t;
      if (kept == 1) at_b /= 2;
      kept = 1;
    } else {
      b = t;
      at_b = at_t;
      if (kept == -1) at_a /= 2;
      kept = -1;
    }
  }
  return b;
}

}  // namespace

std::unique_ptr<RayCaster> field_ray_caster(const ImplicitSurface& of) {
  if (within_cell(of.field(), of.lattice()) >= 1) return nullptr;
  return std::make_unique<GroundCaster<FieldGround>>(of);
}

}  // namespace terrabench
