#include "lod/rtin/nested_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/rtin/samples_under.h"

namespace terrabench::rtin {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float nearest(double metres) {
  return metres > std::numeric_limits<float>::max() ? kInfinity : static_cast<float>(metres);
}

// metres ≥ 0
float rounded_up(double metres) {
  const float near = nearest(metres);
  return near < metres ? std::bit_cast<float>(std::bit_cast<std::uint32_t>(near) + 1) : near;
}

}  // namespace

NestedErrors::NestedErrors(const GroundGrid& grid, bool exact, Progress& progress)
    : grid_(grid), lattice_(grid.width, grid.depth), size_(lattice_.size()), exact_(exact) {
  const glm::ivec2 kept = size_ / kKeptStep + 1;
  require_memory(static_cast<std::size_t>(size_.x) * size_.y * sizeof(Nested), "errors of rtin");
  own_.resize(static_cast<std::size_t>(kept.x) * kept.y);
  nested_.resize(static_cast<std::size_t>(size_.x) * size_.y);
  progress.begin("measuring triangles", static_cast<std::uint64_t>(lattice_.side_log));
  for (int step = 1; step < 1 << lattice_.side_log; step *= 2) {
    nest_level(step, {glm::ivec2(0), size_ - 1});
    progress.advance();
  }
  progress.end();
}

void NestedErrors::update(glm::ivec2 low, glm::ivec2 high) {
  // Lattice points beyond the ground lie over its last samples.
  if (high.x == lattice_.last.x) high.x = size_.x - 1;
  if (high.y == lattice_.last.y) high.y = size_.y - 1;
  for (int step = 1; step < 1 << lattice_.side_log; step *= 2) nest_level(step, {low, high});
}

Bounds NestedErrors::box(const Triangle& t) const {
  constexpr double kLargest = std::numeric_limits<float>::max();
  const glm::vec2 low = plan(glm::min(glm::min(t.a, t.b), t.c)),
                  high = plan(glm::max(glm::max(t.a, t.b), t.c));
  const double middle = grid_.heights[lattice_.vertex(t.middle())], radius = at(t.middle()).radius;
  return {{low.x, static_cast<float>(std::max(middle - radius, -kLargest)), low.y},
          {high.x, static_cast<float>(std::min(middle + radius, kLargest)), high.y}};
}

NestedErrors::Range NestedErrors::around(const Range& range, int steps) const {
  return {glm::max(range.low - steps, 0), glm::min(range.high + steps, size_ - 1)};
}

// The middles of edges of 2 · step along an axis, then those of squares of that side, which depend on them.
// Errors nest, so that points up to 3 · step away from a change are nested again.
void NestedErrors::nest_level(int step, const Range& changed) {
  const auto [low, high] = around(changed, 3 * step);
  const Range own = around(changed, step);
  const int first = (low.y + step - 1) / step, last = high.y / step;
  // The least odd or even multiple of the step from low.x on.
  const auto begin = [step, from = low.x](bool odd) {
    return (from + (odd ? step : 2 * step) - 1) / (2 * step) * 2 * step + (odd ? step : 0);
  };
  tbb::parallel_for(first, last + 1, [&, to = high.x](int row) {
    for (int x = begin(row % 2 == 0); x <= to; x += 2 * step) nest({x, row * step}, step, true, own);
  });
  tbb::parallel_for(first | 1, last + 1, 2, [&, to = high.x](int row) {
    for (int x = begin(true); x <= to; x += 2 * step) nest({x, row * step}, step, false, own);
  });
}

void NestedErrors::nest(glm::ivec2 point, int step, bool edge, const Range& changed) {
  const bool is_changed =
      glm::all(glm::lessThanEqual(changed.low, point)) && glm::all(glm::lessThanEqual(point, changed.high));
  const bool kept = step >= kKeptStep;
  Nested all = kept && !is_changed ? own(point) : measure(point, step, edge);
  if (kept) own(point) = all;
  // Spheres nest with a margin above the rounding of distances from the eye.
  constexpr double kMargin = 1 + 1e-6;
  const glm::dvec3 here = position(point);
  const auto contain = [&](glm::ivec2 child) {
    if (!inside(child)) return;
    const Nested& below = at(child);
    all.error = std::max(all.error, below.error);
    const double reach = glm::distance(here, position(child)) + static_cast<double>(below.radius);
    all.radius = std::max(all.radius, rounded_up(kMargin * reach));
  };
  const int half = step / 2;
  if (!edge) {
    for (const glm::ivec2 off : {glm::ivec2(step, 0), {-step, 0}, {0, step}, {0, -step}})
      contain(point + off);
  } else if (half > 0) {
    for (const glm::ivec2 off : {glm::ivec2(half, half), {half, -half}, {-half, half}, {-half, -half}})
      contain(point + off);
  }
  nested_[place(point)] = all;
}

// Of the one or two triangles that the point splits alone.
Nested NestedErrors::measure(glm::ivec2 point, int step, bool edge) const {
  Nested all;
  if (!edge) {
    Lattice::halves_of_square(point - step, 2 * step, [&](const Triangle& t) { add_triangle(t, all); });
    return all;
  }
  const glm::ivec2 along = point.y / step % 2 == 0 ? glm::ivec2(step, 0) : glm::ivec2(0, step);
  const glm::ivec2 across(along.y, along.x);
  for (const glm::ivec2 apex : {point - across, point + across}) {
    if (inside(apex)) add_triangle({point - along, point + along, apex}, all);
  }
  return all;
}

void NestedErrors::add_triangle(const Triangle& t, Nested& all) const {
  const glm::dvec3 middle = position(t.middle());
  double error = std::abs((position(t.a).y + position(t.b).y) / 2 - middle.y);
  double flat_squared = 0, up = 0;
  bool moved = false;  // by the ground's border
  for (const glm::ivec2 point : {t.a, t.b, t.c}) {
    const glm::dvec3 off = position(point) - middle;
    flat_squared = std::max(flat_squared, off.x * off.x + off.z * off.z);
    up = std::max(up, std::abs(off.y));
    moved = moved || lattice_.sample(point) != point;
  }
  // The spheres of its descendants hold the samples under a triangle that is not moved. Under one that is not
  // split further, these are the middle and the corners.
  if (moved || (exact_ && t.halves().first.splits())) {
    const SamplesUnder under =
        samples_under(grid_, {lattice_.sample(t.a), lattice_.sample(t.b), lattice_.sample(t.c)});
    if (exact_) error = under.error;
    up = std::max({up, under.highest - middle.y, middle.y - under.lowest});
  }
  all.error = std::max(all.error, exact_ ? rounded_up(error) : nearest(error));
  all.radius = std::max(all.radius, rounded_up(std::sqrt(flat_squared + up * up)));
}

}  // namespace terrabench::rtin
