// The cube kernel on planes: prefix sums of the stacks' solid lengths along x within a row of columns, and
// along z from row to row. Two cursors move along z with the low and the high border of the support, so that
// each row is read twice whatever the radius; nothing is kept per row.
//
// All volumes are integers. Where that of a support fits 31 bits, sums are kept modulo 2³²: along a whole row
// they may wrap around, differences across a support come out right. Else they are doubles.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "representations/implicit/stack_field.h"

namespace terrabench {
namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

template <class Volume>
class CubePlanes final : public FieldPlanes {
 public:
  CubePlanes(const StackField&, std::span<const float> xs, std::span<const float> ys);
  void sample(double z, std::span<float> out) override;

 private:
  // The volumes between the low border of the first plane's support and a position along z.
  struct Cursor {
    std::int64_t row = 0;         // that the position lies in
    std::vector<Volume> rows;     // of the rows before it, sums of their `current`
    std::vector<Volume> current;  // of `row`, volumes per unit along z
    int loaded = -1;              // the row of the grid that `current` comes from
  };
  // Where a border lies in the sums along a row: unit · prefix_[at] + coefficient · column_[at].
  struct Place {
    std::size_t at;
    Volume coefficient;
  };
  using Height = std::conditional_t<std::is_same_v<Volume, double>, double, std::int32_t>;
  Place place(std::int64_t unit) const;
  void load_row(Cursor&, std::int64_t row);
  void move(Cursor&, std::int64_t unit);

  const StackField& field_;
  const ColumnGrid& grid_;
  std::vector<Height> v_;                // ys in units
  int first_column_ = 0, columns_ = 0;   // that the supports cover, inside the grid
  std::vector<Place> low_, high_;        // borders of the supports, per xs
  bool between_columns_ = true;          // all borders: coefficients are 0, and `current` counts columns
  std::vector<Volume> column_, prefix_;  // of a row: lengths per column and ys, and their sums
  Cursor low_rows_, high_rows_;
  bool begun_ = false;
};

template <class Volume>
CubePlanes<Volume>::CubePlanes(const StackField& field, std::span<const float> xs, std::span<const float> ys)
    : field_(field), grid_(field.stack_.grid()) {
  for (const float y : ys) v_.push_back(static_cast<Height>(field.unit_y(y)));
  const auto column_of = [&](std::int64_t unit) {
    return static_cast<int>(
        std::clamp<std::int64_t>(floor_div(unit, field.column_unit_), 0, grid_.width - 1));
  };
  first_column_ = column_of(field.unit_x(xs.front()) - field.radius_x_);
  columns_ = column_of(field.unit_x(xs.back()) + field.radius_x_) + 1 - first_column_;
  for (const float x : xs) {
    low_.push_back(place(field.unit_x(x) - field.radius_x_));
    high_.push_back(place(field.unit_x(x) + field.radius_x_));
    between_columns_ = between_columns_ && low_.back().coefficient == 0 && high_.back().coefficient == 0;
  }
  column_.resize(static_cast<std::size_t>(columns_) * v_.size());
  prefix_.resize(column_.size());
}

// Beyond the grid the outermost column continues: the coefficient is negative or exceeds a column.
template <class Volume>
auto CubePlanes<Volume>::place(std::int64_t unit) const -> Place {
  const std::int64_t column =
      std::clamp<std::int64_t>(floor_div(unit, field_.column_unit_) - first_column_, 0, columns_ - 1);
  return {static_cast<std::size_t>(column),
          static_cast<Volume>(unit - (column + first_column_) * field_.column_unit_)};
}

template <class Volume>
void CubePlanes<Volume>::load_row(Cursor& cursor, std::int64_t row) {
  const int j = static_cast<int>(std::clamp<std::int64_t>(row, 0, grid_.depth - 1));
  cursor.row = row;
  if (j == cursor.loaded) return;
  cursor.loaded = j;
  const std::size_t n = v_.size();
  const auto unit = static_cast<Volume>(field_.column_unit_);
  std::fill(column_.begin(), column_.end(), Volume{});
  for (std::size_t c = 0; c < static_cast<std::size_t>(columns_); ++c) {
    Volume* const column = &column_[c * n];
    add_solid_lengths<Height, Volume>(field_.stack_.column(first_column_ + static_cast<int>(c), j),
                                      static_cast<Height>(field_.level_unit_), v_,
                                      static_cast<Height>(field_.radius_y_), 1, std::span(column, n));
    if (c + 1 == static_cast<std::size_t>(columns_)) break;
    const Volume* const before = &prefix_[c * n];
    Volume* const after = &prefix_[(c + 1) * n];
    for (std::size_t k = 0; k < n; ++k) after[k] = before[k] + column[k];
  }
  for (std::size_t i = 0; i < low_.size(); ++i) {
    const Volume low = low_[i].coefficient, high = high_[i].coefficient;
    const Volume *low_prefix = &prefix_[low_[i].at * n], *low_column = &column_[low_[i].at * n];
    const Volume *high_prefix = &prefix_[high_[i].at * n], *high_column = &column_[high_[i].at * n];
    Volume* const out = &cursor.current[i * n];
    if (between_columns_) {
      for (std::size_t k = 0; k < n; ++k) out[k] = high_prefix[k] - low_prefix[k];
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      out[k] = unit * (high_prefix[k] - low_prefix[k]) + high * high_column[k] - low * low_column[k];
    }
  }
}

template <class Volume>
void CubePlanes<Volume>::move(Cursor& cursor, std::int64_t unit) {
  const std::int64_t target = floor_div(unit, field_.column_unit_);
  while (cursor.row < target) {
    // Beyond the grid all rows equal the outermost one: one step.
    std::int64_t next = cursor.row + 1;
    if (cursor.row < 0) next = std::min<std::int64_t>(target, 0);
    if (cursor.row >= grid_.depth - 1) next = target;
    if (next == cursor.row + 1) {
      for (std::size_t at = 0; at < cursor.rows.size(); ++at) cursor.rows[at] += cursor.current[at];
    } else {
      const auto rows = static_cast<Volume>(next - cursor.row);
      for (std::size_t at = 0; at < cursor.rows.size(); ++at) cursor.rows[at] += rows * cursor.current[at];
    }
    load_row(cursor, next);
  }
}

template <class Volume>
void CubePlanes<Volume>::sample(double z, std::span<float> out) {
  const std::int64_t at = field_.unit_z(z), low = at - field_.radius_z_, high = at + field_.radius_z_;
  if (!begun_) {
    begun_ = true;
    for (Cursor* cursor : {&low_rows_, &high_rows_}) {
      cursor->rows.assign(out.size(), Volume{});
      cursor->current.resize(out.size());
      load_row(*cursor, floor_div(low, field_.column_unit_));
    }
  }
  move(low_rows_, low);
  move(high_rows_, high);
  const auto low_part = static_cast<Volume>(low - low_rows_.row * field_.column_unit_);
  const auto high_part = static_cast<Volume>(high - high_rows_.row * field_.column_unit_);
  const auto unit = static_cast<double>(field_.column_unit_);
  const double support = field_.support_, scale = between_columns_ ? unit : 1;
  // The quotient is the same to the bit where the support is a power of 2.
  int exponent = 0;
  const bool divides = std::frexp(support, &exponent) != 0.5;
  const auto finish = [&](double factor, const auto& volume) {
    const double twice = 2 * factor, inverse = 1 / support;
    const auto exact = [&](std::size_t k) { return twice * static_cast<Height>(volume(k)) - support; };
    if (divides) {
      for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<float>(exact(k) / support);
    } else {
      for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<float>(exact(k) * inverse);
    }
  };
  const Volume *high_rows = high_rows_.rows.data(), *low_rows = low_rows_.rows.data(),
               *high_current = high_rows_.current.data(), *low_current = low_rows_.current.data();
  if (low_part == 0 && high_part == 0) {
    finish(scale * unit, [&](std::size_t k) { return high_rows[k] - low_rows[k]; });
  } else {
    const auto row = static_cast<Volume>(field_.column_unit_);
    finish(scale, [&](std::size_t k) {
      return row * (high_rows[k] - low_rows[k]) + high_part * high_current[k] - low_part * low_current[k];
    });
  }
}

namespace {

class SpherePlanes final : public FieldPlanes {
 public:
  SpherePlanes(const StackField& field, std::span<const float> xs, std::span<const float> ys)
      : field_(field), xs_(xs), ys_(ys) {}
  void sample(double z, std::span<float> out) override {
    for (std::size_t i = 0; i < xs_.size(); ++i) {
      field_.line(xs_[i], z, ys_, out.subspan(i * ys_.size(), ys_.size()));
    }
  }

 private:
  const StackField& field_;
  std::span<const float> xs_, ys_;
};

}  // namespace

std::unique_ptr<FieldPlanes> StackField::planes(std::span<const float> xs, std::span<const float> ys) const {
  if (kernel_ == Kernel::kSphere) return std::make_unique<SpherePlanes>(*this, xs, ys);
  const double highest = std::max(std::abs(unit_y(ys.front())), std::abs(unit_y(ys.back())));
  if (support_ < 0x1p31 && highest + static_cast<double>(radius_y_) < 0x1p29)
    return std::make_unique<CubePlanes<std::uint32_t>>(*this, xs, ys);
  return std::make_unique<CubePlanes<double>>(*this, xs, ys);
}

}  // namespace terrabench
