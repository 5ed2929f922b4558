// The field of the hybrid paper's implicit surface (§3.1.2, after Peytavie et al. 2009): material stacks, +1
// where they are solid and -1 in air, convolved with a kernel of radius σ. With V the volume of material
// inside the kernel's support around p and V_all the support's volume, f(p) = 2 V / V_all - 1: exactly 1
// where the support is full, exactly -1 where it is empty, exactly 0 where it is half full.
//
// Exactly, because all volumes are sums of integers: positions and radius are rounded to a fraction of a
// column and of a level (1/256 for the cube, coarser for very large kernels; in plan 1/8 of a column for the
// sphere). Points at the columns' corners, and a radius of whole columns, are not rounded at all.
//
// The ground continues: beyond the sides as the outermost columns, below the floor as the lowest level.
// Above the highest level is air.
//
// Cube: volumes are differences of prefix sums along y, x and z in turn, so that a sample of planes() costs
// the same for any σ. Sphere: sphere_chords.h; a sample costs O((σ / column)²).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <vector>

#include "representations/implicit/sampled_field.h"
#include "representations/implicit/sphere_chords.h"
#include "representations/layered_stack/layered_stack.h"
#include "terrain/memory.h"

namespace terrabench {

template <class Volume>
class CubePlanes;

enum class Kernel : std::uint8_t { kCube, kSphere };
inline constexpr std::array<std::string_view, 2> kKernelNames{"cube", "sphere"};

// The heights of stacks' columns in one array, for sampling the field at single points: a sample with the
// cube kernel reads some 25 columns, and from here each costs one load, where it is one solid stretch from
// the floor up. 2 B per column.
class ColumnTops {
 public:
  static constexpr std::uint16_t kOther = 0xFFFF;  // not one stretch, or as high: ask the stack

  // Does not follow later edits. O(runs)
  explicit ColumnTops(const LayeredStack& stack) : width_(static_cast<std::size_t>(stack.grid().width)) {
    tops_.reserve(stack.grid().columns());
    for (int j = 0; j < stack.grid().depth; ++j) {
      for (int i = 0; i < stack.grid().width; ++i) tops_.push_back(top(stack.column(i, j)));
    }
  }

  // In levels.
  const std::uint16_t* row(int j) const { return tops_.data() + static_cast<std::size_t>(j) * width_; }
  std::size_t bytes() const { return heap_bytes(tops_.data()); }

 private:
  static std::uint16_t top(const ColumnRuns& runs) {
    return runs.count == 0 || runs.grounded() < runs.count ? kOther : runs.tops[runs.count - 1];
  }

  std::size_t width_;
  std::vector<std::uint16_t> tops_;
};

class StackField final : public SampledField {
 public:
  // `radius` in metres, positive. Keeps a reference to the stacks, which may be edited between calls. Throws
  // usage_error for a sphere of more than SphereChords::kMaxRadius columns, and for a cube whose volume in
  // units exceeds the exact integers of a double (a radius of some thousand columns).
  StackField(const LayeredStack&, Kernel, double radius);

  Kernel kernel() const { return kernel_; }
  double radius() const { return radius_; }
  // How far positions along x or z and the radius together may be moved by rounding, metres.
  double rounding() const;

  std::unique_ptr<FieldPlanes> planes(std::span<const float> xs, std::span<const float> ys) const override;
  float at(glm::vec3) const override;
  // The same to the bit, with the cube several times as fast. `tops` are the stacks' own.
  float at(glm::vec3, const ColumnTops& tops) const;
  Heights heights(glm::dvec2 low, glm::dvec2 high) const override;
  // A height at and above which the field is nowhere positive over the rectangle: one level, for rounding,
  // above the highest solid in the kernel's reach. From there at most half of the kernel lies in the solid.
  // -infinity if all columns in reach are air. O(columns in reach)
  double highest(glm::dvec2 low, glm::dvec2 high, const ColumnTops& tops) const;
  // Bounds on how fast the field changes: between two points whose offset is `apart` (metres along each
  // axis), it changes by at most steepest(apart) + jump(). The cube's bound has no margin. The sphere's has
  // 6 %, because its table of chords only approximates a sphere.
  double steepest(glm::dvec3 apart) const;
  double jump() const;
  // Whether, at equal height, the field is linear along x and along z between any two neighbours of these
  // positions: with the cube and a radius of whole columns, wherever no column's border lies between them.
  bool linear_between(std::span<const float> xs, std::span<const float> zs) const;
  // Along a vertical line: heights y ascend. O(columns of the support · (their runs + y)).
  void line(double x, double z, std::span<const float> y, std::span<float> out) const;
  Memory memory() const { return chords_.memory(); }

 private:
  template <class Volume>
  friend class CubePlanes;
  // The columns that the kernel reaches from a rectangle: [first, last] along x and z.
  struct Reach {
    int first_i, last_i, first_j, last_j;
  };
  Reach reach(glm::dvec2 low, glm::dvec2 high) const;
  // Positions in units from the grid's border or floor.
  std::int64_t unit_x(double x) const;
  std::int64_t unit_z(double z) const;
  double unit_y(double y) const;
  void cube_volumes(double x, double z, std::span<const double> v, std::span<double> volume) const;
  // The columns that the cube meets along one axis, and how much of it lies over each, in units.
  struct Shares {
    static constexpr int kMost = 32;
    int first, count;
    std::array<double, kMost> share;
  };
  bool shares(std::int64_t at, std::int64_t radius, int columns, Shares& out) const;  // false: too many
  // Both add to `volume`. Returns the volume of the whole sphere; `steps`: one zero more than y.
  double sphere_volumes(double x, double z, std::span<const float> y, std::span<double> volume,
                        std::span<double> steps) const;

  const LayeredStack& stack_;
  Kernel kernel_;
  double radius_;
  std::int64_t column_unit_ = 256, level_unit_ = 256;        // units per column and per level
  std::int64_t radius_x_ = 0, radius_y_ = 0, radius_z_ = 0;  // in units
  double support_ = 0;                                       // volume of the cube, in units
  SphereChords chords_;
};

// Adds to volume[k] the length of the column's solid part in [v[k] - radius, v[k] + radius], times `weight`.
// `v` ascends, in units of which a level has `per_level`. The lowest level continues downward. Heights are
// doubles, or below 2²⁹ in int32; volumes may wrap around.
template <class Height, class Volume>
void add_solid_lengths(const ColumnRuns& runs, Height per_level, std::span<const Height> v, Height radius,
                       Volume weight, std::span<Volume> volume) {
  constexpr auto kBelow = static_cast<Height>(std::is_same_v<Height, double> ? -1e18 : -0x1p30);
  std::size_t first = 0;
  Height bottom = kBelow;  // where the lowest run begins
  for (std::size_t r = 0; r < runs.count; ++r) {
    const Height top = runs.tops[r] * per_level;
    if (runs.materials[r] != Material::kAir) {
      const auto from = v.begin() + static_cast<std::ptrdiff_t>(first);
      first = static_cast<std::size_t>(std::upper_bound(from, v.end(), bottom - radius) - v.begin());
      const auto end = static_cast<std::size_t>(std::lower_bound(from, v.end(), top + radius) - v.begin());
      for (std::size_t k = first; k < end; ++k) {
        const Height length = std::min(v[k] + radius, top) - std::max(v[k] - radius, bottom);
        volume[k] += weight * static_cast<Volume>(length);
      }
    }
    bottom = top;
  }
}

}  // namespace terrabench
