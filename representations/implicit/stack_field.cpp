#include "representations/implicit/stack_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr double kExact = 9007199254740992.0;  // 2⁵³: doubles hold all integers up to it
constexpr double kFar = 1e12;                  // positions farther outside, in units, all see the same ground

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

std::int64_t rounded(double units) { return std::llround(std::clamp(units, -kFar, kFar)); }

}  // namespace

StackField::StackField(const LayeredStack& stack, Kernel kernel, double radius)
    : stack_(stack), kernel_(kernel), radius_(radius) {
  const ColumnGrid& grid = stack.grid();
  if (kernel == Kernel::kSphere) {
    const double cell = std::min(grid.cell_x, grid.cell_z);
    if (!(radius <= SphereChords::kMaxRadius * cell)) {
      throw usage_error(fmt::format("a sphere of radius {} m reaches farther than {} columns of {} m", radius,
                                    SphereChords::kMaxRadius, cell),
                        "parameter 'radius'", "choose a smaller radius, or the cube kernel");
    }
    chords_ = SphereChords(radius, grid.cell_x, grid.cell_z);
    return;
  }
  // The largest sum is that over all rows, of the support's extent along x and y.
  const auto largest = [&] {
    const auto columns = static_cast<double>(column_unit_), levels = static_cast<double>(level_unit_);
    const double along_x = radius / grid.cell_x * columns, along_z = radius / grid.cell_z * columns,
                 along_y = radius / grid.step * levels;
    return 2 * (along_y + 1) * (grid.width * columns + 2 * along_x + 2) *
           (grid.depth * columns + 2 * along_z + 2);
  };
  while (!(largest() < kExact)) {
    if (level_unit_ == 1 && column_unit_ == 1) {
      throw usage_error(
          fmt::format("a cube of radius {} m is too large for columns of {} m × {} m and levels of {} m",
                      radius, grid.cell_x, grid.cell_z, grid.step),
          "parameter 'radius'", "choose a smaller radius");
    }
    (level_unit_ > 1 ? level_unit_ : column_unit_) /= 2;
  }
  const auto at_least_one = [](double units) { return std::max<std::int64_t>(1, rounded(units)); };
  radius_x_ = at_least_one(radius / grid.cell_x * static_cast<double>(column_unit_));
  radius_y_ = at_least_one(radius / grid.step * static_cast<double>(level_unit_));
  radius_z_ = at_least_one(radius / grid.cell_z * static_cast<double>(column_unit_));
  support_ =
      8.0 * static_cast<double>(radius_x_) * static_cast<double>(radius_y_) * static_cast<double>(radius_z_);
}

double StackField::rounding() const {
  const double cell = std::max(stack_.grid().cell_x, stack_.grid().cell_z);
  return kernel_ == Kernel::kSphere ? cell / (2 * SphereChords::kPhases)
                                    : cell / static_cast<double>(column_unit_);
}

std::int64_t StackField::unit_x(double x) const {
  const ColumnGrid& grid = stack_.grid();
  return rounded((x - grid.origin_x) / grid.cell_x * static_cast<double>(column_unit_));
}
std::int64_t StackField::unit_z(double z) const {
  const ColumnGrid& grid = stack_.grid();
  return rounded((z - grid.origin_z) / grid.cell_z * static_cast<double>(column_unit_));
}
double StackField::unit_y(double y) const {
  const ColumnGrid& grid = stack_.grid();
  return static_cast<double>(rounded((y - grid.origin_y) / grid.step * static_cast<double>(level_unit_)));
}

// Moved by a length along one axis, the cube loses a slab of its support and takes in another: at most the
// length's share of the radius changes from solid to air. The sphere loses at most its cross-section times
// the length.
double StackField::steepest(glm::dvec3 apart) const {
  if (kernel_ == Kernel::kSphere) return 1.06 * 1.5 * glm::length(apart) / radius_;
  const ColumnGrid& grid = stack_.grid();
  const auto share = [](double metres, double cell, std::int64_t unit, std::int64_t radius) {
    return std::abs(metres) / cell * static_cast<double>(unit) / static_cast<double>(radius);
  };
  return share(apart.x, grid.cell_x, column_unit_, radius_x_) +
         share(apart.y, grid.step, level_unit_, radius_y_) +
         share(apart.z, grid.cell_z, column_unit_, radius_z_);
}

// Rounding moves each of two points by up to half a unit, or half a phase.
double StackField::jump() const {
  constexpr double kFloat = 1e-6;  // more than rounding the result
  if (kernel_ == Kernel::kSphere) {
    const ColumnGrid& grid = stack_.grid();
    return steepest({grid.cell_x / SphereChords::kPhases, 0, grid.cell_z / SphereChords::kPhases}) + kFloat;
  }
  return 1.0 / static_cast<double>(radius_x_) + 1.0 / static_cast<double>(radius_y_) +
         1.0 / static_cast<double>(radius_z_) + kFloat;
}

bool StackField::linear_between(std::span<const float> xs, std::span<const float> zs) const {
  if (kernel_ != Kernel::kCube || radius_x_ % column_unit_ != 0 || radius_z_ % column_unit_ != 0)
    return false;
  const auto none_between = [&](std::span<const float> at, std::int64_t (StackField::*unit)(double) const) {
    return std::ranges::adjacent_find(at, [&](float a, float b) {
             return floor_div((this->*unit)(b)-1, column_unit_) > floor_div((this->*unit)(a), column_unit_);
           }) == at.end();
  };
  return none_between(xs, &StackField::unit_x) && none_between(zs, &StackField::unit_z);
}

void StackField::cube_volumes(double x, double z, std::span<const double> v, std::span<double> volume) const {
  const ColumnGrid& grid = stack_.grid();
  // A column's share of the support along one axis; the outermost columns stand for all beyond them.
  const auto share = [&](std::int64_t column, int count, std::int64_t low, std::int64_t high) {
    if (column > 0) low = std::max(low, column * column_unit_);
    if (column < count - 1) high = std::min(high, (column + 1) * column_unit_);
    return static_cast<double>(std::max<std::int64_t>(0, high - low));
  };
  const auto column_of = [&](std::int64_t unit, int count) {
    return static_cast<int>(std::clamp<std::int64_t>(floor_div(unit, column_unit_), 0, count - 1));
  };
  const std::int64_t at_x = unit_x(x), at_z = unit_z(z);
  const std::int64_t x0 = at_x - radius_x_, x1 = at_x + radius_x_, z0 = at_z - radius_z_,
                     z1 = at_z + radius_z_;
  for (int j = column_of(z0, grid.depth); j <= column_of(z1, grid.depth); ++j) {
    const double along_z = share(j, grid.depth, z0, z1);
    for (int i = column_of(x0, grid.width); i <= column_of(x1, grid.width); ++i) {
      const double weight = along_z * share(i, grid.width, x0, x1);
      if (weight == 0) continue;
      add_solid_lengths<double, double>(stack_.column(i, j), static_cast<double>(level_unit_), v,
                                        static_cast<double>(radius_y_), weight, volume);
    }
  }
}

// A column contributes, per end of its solid runs, the sphere's volume over it below that end. Within the
// radius of the end this comes from the table; centres farther away see all or nothing of it, which `steps`
// adds: the part from number k on is steps[0] + … + steps[k].
double StackField::sphere_volumes(double x, double z, std::span<const float> y, std::span<double> volume,
                                  std::span<double> steps) const {
  const ColumnGrid& grid = stack_.grid();
  constexpr int kPhases = SphereChords::kPhases, kSteps = SphereChords::kSteps;
  const std::int64_t at_x = rounded((x - grid.origin_x) / grid.cell_x * kPhases),
                     at_z = rounded((z - grid.origin_z) / grid.cell_z * kPhases);
  const std::int64_t i0 = floor_div(at_x, kPhases), j0 = floor_div(at_z, kPhases);
  const int phase_x = static_cast<int>(at_x - i0 * kPhases), phase_z = static_cast<int>(at_z - j0 * kPhases);
  const auto add = [&](std::span<const std::int32_t> chords, double end, double sign) {
    const auto first =
        static_cast<std::size_t>(std::upper_bound(y.begin(), y.end(), end - radius_) - y.begin());
    const auto last =
        static_cast<std::size_t>(std::lower_bound(y.begin(), y.end(), end + radius_) - y.begin());
    const double half = sign * chords.back();
    steps[0] += half;
    steps[first] -= half;
    steps[std::max(first, last)] -= half;
    for (std::size_t k = first; k < last; ++k) {
      const double t = end - y[k], s = std::min(std::abs(t) / radius_ * kSteps, double{kSteps});
      const auto below = std::min(static_cast<std::size_t>(s), std::size_t{kSteps - 1});
      // Rounded to an integer alike for t and -t.
      const double part = std::nearbyint(chords[below] + (s - static_cast<double>(below)) *
                                                             (chords[below + 1] - chords[below]));
      volume[k] += t < 0 ? -sign * part : sign * part;
    }
  };
  for (int dz = -chords_.reach_z(); dz <= chords_.reach_z(); ++dz) {
    for (int dx = -chords_.reach_x(); dx <= chords_.reach_x(); ++dx) {
      const std::span<const std::int32_t> chords = chords_.column(phase_x, phase_z, dx, dz);
      if (chords.back() == 0) continue;
      const auto column_at = [](std::int64_t at, int count) {
        return static_cast<int>(std::clamp<std::int64_t>(at, 0, count - 1));
      };
      const ColumnRuns runs = stack_.column(column_at(i0 + dx, grid.width), column_at(j0 + dz, grid.depth));
      runs.each_solid([&](int bottom, int top, Material) {
        add(chords, grid.origin_y + top * grid.step, 1);
        if (bottom > 0) {
          add(chords, grid.origin_y + bottom * grid.step, -1);
        } else {
          steps[0] += chords.back();  // the lowest level continues downward
        }
      });
    }
  }
  double whole = 0;
  for (std::size_t k = 0; k < y.size(); ++k) volume[k] += whole += steps[k];
  return static_cast<double>(chords_.total(phase_x, phase_z));
}

void StackField::line(double x, double z, std::span<const float> y, std::span<float> out) const {
  std::vector<double> volume(y.size(), 0.0), scratch(y.size() + 1, 0.0);
  double support = support_;
  if (kernel_ == Kernel::kCube) {
    for (std::size_t k = 0; k < y.size(); ++k) scratch[k] = unit_y(y[k]);
    cube_volumes(x, z, std::span(scratch).first(y.size()), volume);
  } else {
    support = sphere_volumes(x, z, y, volume, scratch);
  }
  for (std::size_t k = 0; k < y.size(); ++k) {
    out[k] = static_cast<float>((2 * volume[k] - support) / support);
  }
}

// As line(), without heap memory.
float StackField::at(glm::vec3 p) const {
  double volume = 0, support = support_;
  if (kernel_ == Kernel::kCube) {
    const double v = unit_y(p.y);
    cube_volumes(p.x, p.z, std::span(&v, 1), std::span(&volume, 1));
  } else {
    std::array<double, 2> steps{};
    support = sphere_volumes(p.x, p.z, std::span(&p.y, 1), std::span(&volume, 1), steps);
  }
  return static_cast<float>((2 * volume - support) / support);
}

bool StackField::shares(std::int64_t at, std::int64_t radius, int columns, Shares& out) const {
  const int shift = std::countr_zero(static_cast<std::uint64_t>(column_unit_));  // a power of 2
  const auto column_of = [&](std::int64_t unit) {
    return static_cast<int>(std::clamp<std::int64_t>(unit >> shift, 0, columns - 1));
  };
  const std::int64_t low = at - radius, high = at + radius;
  out.first = column_of(low);
  const int last = column_of(high);
  out.count = last - out.first + 1;
  if (out.count > Shares::kMost) return false;
  for (int k = 0; k < out.count; ++k)
    out.share[static_cast<std::size_t>(k)] = static_cast<double>(column_unit_);
  // The outermost columns stand for all beyond them.
  const auto border = [&](int column) { return static_cast<double>(column * column_unit_); };
  out.share[0] = border(out.first + 1) - static_cast<double>(low);
  double& end = out.share[static_cast<std::size_t>(out.count - 1)];
  end = out.count == 1 ? static_cast<double>(high - low) : static_cast<double>(high) - border(last);
  return true;
}

// All volumes are integers, so that the order in which they are added does not matter.
float StackField::at(glm::vec3 p, const ColumnTops& tops) const {
  const ColumnGrid& grid = stack_.grid();
  Shares along_x, along_z;
  if (kernel_ != Kernel::kCube || !shares(unit_x(p.x), radius_x_, grid.width, along_x) ||
      !shares(unit_z(p.z), radius_z_, grid.depth, along_z)) {
    return at(p);
  }
  const auto per_level = static_cast<double>(level_unit_), radius = static_cast<double>(radius_y_);
  const double v = unit_y(p.y), low = v - radius;
  double volume = 0;
  for (int b = 0; b < along_z.count; ++b) {
    const std::uint16_t* const row = tops.row(along_z.first + b) + along_x.first;
    double sum = 0;
    for (int a = 0; a < along_x.count; ++a) {
      const double share = along_x.share[static_cast<std::size_t>(a)];
      if (row[a] == ColumnTops::kOther) [[unlikely]] {
        add_solid_lengths<double, double>(stack_.column(along_x.first + a, along_z.first + b), per_level,
                                          std::span(&v, 1), radius, share, std::span(&sum, 1));
      } else {
        sum += share * std::clamp(row[a] * per_level - low, 0.0, 2 * radius);
      }
    }
    volume += along_z.share[static_cast<std::size_t>(b)] * sum;
  }
  return static_cast<float>((2 * volume - support_) / support_);
}

StackField::Reach StackField::reach(glm::dvec2 low, glm::dvec2 high) const {
  const ColumnGrid& grid = stack_.grid();
  const double reach = radius_ + rounding();
  const auto column_of = [](double at, double origin, double cell, int count) {
    return static_cast<int>(std::clamp(std::floor((at - origin) / cell), 0.0, count - 1.0));
  };
  return {column_of(low.x - reach, grid.origin_x, grid.cell_x, grid.width),
          column_of(high.x + reach, grid.origin_x, grid.cell_x, grid.width),
          column_of(low.y - reach, grid.origin_z, grid.cell_z, grid.depth),
          column_of(high.y + reach, grid.origin_z, grid.cell_z, grid.depth)};
}

double StackField::highest(glm::dvec2 low, glm::dvec2 high, const ColumnTops& tops) const {
  const ColumnGrid& grid = stack_.grid();
  const Reach columns = reach(low, high);
  int highest = 0;
  for (int j = columns.first_j; j <= columns.last_j; ++j) {
    const std::uint16_t* const row = tops.row(j);
    for (int i = columns.first_i; i <= columns.last_i; ++i) {
      int top = row[i];
      if (top == ColumnTops::kOther) [[unlikely]] {
        top = stack_.column(i, j).highest();
      }
      highest = std::max(highest, top);
    }
  }
  if (highest == 0) return -std::numeric_limits<double>::infinity();
  return grid.origin_y + (highest + 1) * grid.step;  // a level more than rounding along y
}

SampledField::Heights StackField::heights(glm::dvec2 low, glm::dvec2 high) const {
  const ColumnGrid& grid = stack_.grid();
  const Reach columns = reach(low, high);
  int lowest_air = grid.levels, highest_solid = 0;
  for (int j = columns.first_j; j <= columns.last_j; ++j) {
    for (int i = columns.first_i; i <= columns.last_i; ++i) {
      const ColumnRuns runs = stack_.column(i, j);
      const std::size_t solid = runs.grounded();
      lowest_air = std::min<int>(lowest_air, solid == 0 ? 0 : runs.tops[solid - 1]);
      highest_solid = std::max(highest_solid, runs.highest());
    }
  }
  if (highest_solid == 0) return {0, 0};
  const double margin = radius_ + grid.step;  // more than rounding along y
  return {lowest_air == 0 ? -1e300 : grid.origin_y + lowest_air * grid.step - margin,
          grid.origin_y + highest_solid * grid.step + margin};
}

}  // namespace terrabench
