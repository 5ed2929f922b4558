#include "representations/implicit/block_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

namespace terrabench {

FieldLattice::FieldLattice(const Bounds& bounds, float cell_size)
    : low(bounds.low), high(bounds.high), cell(cell_size) {
  for (int axis = 0; axis < 3; ++axis) {
    // A remainder below a thousandth of a cell is rounding, not ground.
    const double count = std::ceil(static_cast<double>(bounds.size()[axis]) / cell_size - 1e-3);
    cells[axis] = std::max(1, static_cast<int>(count));
  }
}

std::optional<FieldLattice::Levels> FieldLattice::levels(const SampledField& field, glm::ivec2 begin,
                                                         glm::ivec2 end) const {
  const auto [solid, air] =
      field.heights({position(0, begin.x), position(2, begin.y)}, {position(0, end.x), position(2, end.y)});
  if (!(solid < air)) return std::nullopt;
  const auto point = [&](double y) {
    return std::clamp((y - low.y) / cell, 0.0, static_cast<double>(cells.y));
  };
  const int last = static_cast<int>(std::ceil(point(air)));
  return Levels{std::min(last, static_cast<int>(std::floor(point(solid)))), last};
}

BlockSweep::BlockSweep(const BlockTask& task)
    : task_(task), z_(task.begin.y), width_(static_cast<std::size_t>(task.end.x - task.begin.x) + 3) {
  const auto levels = task.lattice.levels(task.field, task.begin - 1, task.end + 1);
  if (!levels) return;
  const int first = task.closed ? 0 : levels->first;
  first_y_ = first - 1;
  points_ = levels->last - first + 3;
  for (int i = task.begin.x - 1; i <= task.end.x + 1; ++i) xs_.push_back(task.lattice.position(0, i));
  for (int n = 0; n < points_; ++n) ys_.push_back(task.lattice.position(1, first_y_ + n));
  for (int j = task.begin.y - 1; j <= task.end.y + 1; ++j) zs_.push_back(task.lattice.position(2, j));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float>& at = axis == 0 ? xs_ : axis == 1 ? ys_ : zs_;
    std::vector<float>& per_metre = per_metre_[static_cast<std::size_t>(axis)];
    per_metre.assign(at.size(), 0);
    for (std::size_t n = 1; n + 1 < at.size(); ++n) per_metre[n] = 1 / (at[n + 1] - at[n - 1]);
  }
  words_ = static_cast<std::size_t>(points_ + 63) / 64;
  values_.resize(4 * width_ * ys_.size());
  bits_.resize(4 * width_ * words_);
  planes_ = task.field.planes(xs_, ys_);
  for (int j = z_ - 1; j <= std::min(z_ + 2, task.end.y + 1); ++j) load(j);
}

void BlockSweep::load(int j) {
  planes_->sample(zs_[static_cast<std::size_t>(j - task_.begin.y + 1)],
                  std::span(values_).subspan(slot(j) * width_ * ys_.size(), width_ * ys_.size()));
  set_bits(j);
}

// Sets bit n where values[n] > 0. `bits` is 0. Bytes first, which compilers vectorise, then eight to a byte
// by one multiplication.
static void pack_positive(std::span<const float> values, std::uint64_t* bits) {
  for (std::size_t first = 0; first < values.size(); first += 64) {
    const std::size_t count = std::min<std::size_t>(64, values.size() - first);
    std::array<std::uint8_t, 64> positive{};
    for (std::size_t n = 0; n < count; ++n) positive[n] = values[first + n] > 0 ? 1 : 0;
    std::uint64_t word = 0;
    for (std::size_t byte = 0; byte < 8; ++byte) {
      std::uint64_t eight = 0;
      std::memcpy(&eight, &positive[8 * byte], sizeof eight);
      word |= (eight * 0x0102040810204080U >> 56) << (8 * byte);
    }
    bits[first / 64] = word;
  }
}

void BlockSweep::set_bits(int j) {
  std::uint64_t* const plane = &bits_[slot(j) * width_ * words_];
  const float* values = &values_[slot(j) * width_ * ys_.size()];
  std::fill(plane, plane + width_ * words_, 0);
  if (task_.closed && (j < 0 || j > task_.lattice.cells.z)) return;
  for (std::size_t i = 0; i < width_; ++i, values += ys_.size()) {
    const int x = task_.begin.x - 1 + static_cast<int>(i);
    if (task_.closed && (x < 0 || x > task_.lattice.cells.x)) continue;
    std::uint64_t* column = plane + i * words_;
    pack_positive({values, ys_.size()}, column);
    const std::size_t end = ys_.size() - 1;
    column[0] &= ~std::uint64_t{1};
    column[end / 64] &= ~(std::uint64_t{1} << (end % 64));
    if (task_.closed) continue;
    column[0] |= column[0] >> 1 & 1;
    column[end / 64] |= (column[(end - 1) / 64] >> ((end - 1) % 64) & 1) << (end % 64);
  }
  if (task_.closed) return;
  const auto copy = [&](std::size_t from, std::size_t to) {
    std::copy_n(plane + from * words_, words_, plane + to * words_);
  };
  copy(1, 0);
  copy(width_ - 2, width_ - 1);
  // Planes outside the block equal the plane at its border, which is sampled after the first and before the
  // last.
  const std::size_t size = width_ * words_;
  if (j == task_.begin.y) std::copy_n(plane, size, &bits_[slot(j - 1) * size]);
  if (j == task_.end.y + 1) std::copy_n(&bits_[slot(j - 1) * size], size, plane);
}

void BlockSweep::advance() {
  ++z_;
  if (z_ + 2 <= task_.end.y + 1) load(z_ + 2);
}

std::uint64_t BlockSweep::crossed_cells(int i, int j, std::size_t w) const {
  const std::uint64_t *a = solid(i, j), *b = solid(i + 1, j), *c = solid(i, j + 1), *d = solid(i + 1, j + 1);
  const std::uint64_t any = a[w] | b[w] | c[w] | d[w], all = a[w] & b[w] & c[w] & d[w];
  const std::uint64_t any_above = above(a, w) | above(b, w) | above(c, w) | above(d, w);
  const std::uint64_t all_above = above(a, w) & above(b, w) & above(c, w) & above(d, w);
  return (any | any_above) & ~(all & all_above);
}

int BlockSweep::cell_case(int i, int j, int n) const {
  int solid_corners = 0;
  for (int corner = 0; corner < 8; corner += 2) {
    // Corners along x are 1 apart, along y 2, along z 4.
    const int m = n + (corner >> 1 & 1), z = j + (corner >> 2);
    solid_corners |= static_cast<int>(bit(solid(i, z), m)) << corner;
    solid_corners |= static_cast<int>(bit(solid(i + 1, z), m)) << (corner + 1);
  }
  return solid_corners;
}

bool BlockSweep::outside(glm::ivec3 point) const {
  const int k = first_y_ + point.y;
  const glm::ivec3 cells = task_.lattice.cells;
  return point.x < 0 || point.x > cells.x || k < 0 || k > cells.y || point.z < 0 || point.z > cells.z;
}

glm::vec3 BlockSweep::gradient(glm::ivec3 p) const {
  const float* const here = column(p.x, p.z) + p.y;
  const auto stride = static_cast<std::ptrdiff_t>(ys_.size());
  return {(here[stride] - here[-stride]) * per_metre_[0][static_cast<std::size_t>(p.x - task_.begin.x + 1)],
          (here[1] - here[-1]) * per_metre_[1][static_cast<std::size_t>(p.y)],
          (column(p.x, p.z + 1)[p.y] - column(p.x, p.z - 1)[p.y]) *
              per_metre_[2][static_cast<std::size_t>(p.z - task_.begin.y + 1)]};
}

// Central differences over the task's step at any position.
glm::vec3 BlockSweep::gradient_at(glm::vec3 p) const {
  glm::vec3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 low = p, high = p;
    low[axis] -= task_.gradient_step;
    high[axis] += task_.gradient_step;
    slope[axis] = task_.field.at(high) - task_.field.at(low);
  }
  return slope;
}

BlockSweep::Crossing BlockSweep::crossing(int axis, int i, int j, int n) const {
  const glm::ivec3 low{i, n, j};
  glm::ivec3 high = low;
  ++high[axis];
  const bool solid_low = bit(solid(i, j), n);
  glm::vec3 outward(0);
  outward[axis] = solid_low ? 1.0F : -1.0F;
  if (task_.closed && (outside(low) || outside(high))) return {place(solid_low ? low : high), outward};
  const float a = column(low.x, low.z)[low.y], b = column(high.x, high.z)[high.y];
  const float t = a / (a - b);
  Crossing at;
  at.position = place(low);
  at.position[axis] = (1 - t) * at.position[axis] + t * place(high)[axis];
  const glm::vec3 slope =
      task_.gradient_step > 0 ? gradient_at(at.position) : (1 - t) * gradient(low) + t * gradient(high);
  const float square = glm::dot(slope, slope);
  at.normal = square > 0 ? slope / -std::sqrt(square) : outward;
  return at;
}

}  // namespace terrabench
