#include "terrain/resampling.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/error.h"
#include "terrain/heightfield.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// New cell k covers [k, k + 1)·from/to of the old axis. Whole numbers keep the borders exact: in units of
// 1/to old cells, cell k runs from k·from to (k + 1)·from.
Taps area_taps(long from, long to, long k) {
  const long begin = k * from, end = begin + from;
  const long first = begin / to, last = (end - 1) / to;
  Taps taps;
  taps.first = static_cast<int>(first);
  taps.count = static_cast<int>(last - first + 1);
  if (taps.count == 1) return taps;
  const auto share = [&](long units) { return static_cast<double>(units) / static_cast<double>(from); };
  taps.first_weight = share((first + 1) * to - begin);
  taps.inner_weight = share(to);
  taps.last_weight = share(end - last * to);
  return taps;
}

// New sample k lies at the centre of its cell; beyond the outermost old samples their height is used.
Taps linear_taps(int from, int to, int k) {
  const double at = std::clamp((k + 0.5) * from / to - 0.5, 0.0, from - 1.0);
  Taps taps;
  taps.first = std::min(static_cast<int>(at), from - 1);
  const double share = at - taps.first;
  if (share == 0) return taps;
  taps.count = 2;
  taps.first_weight = 1 - share;
  taps.last_weight = share;
  return taps;
}

// Whole numbers keep samples that fall on an old one exact: in units of 1/(to - 1) old cells, sample k lies
// at k·(from - 1).
Taps gridline_taps_at(long from, long to, long k) {
  Taps taps;
  if (from == 1 || to == 1) return taps;
  const long at = k * (from - 1), unit = to - 1;
  taps.first = static_cast<int>(at / unit);
  if (at % unit == 0) return taps;
  taps.count = 2;
  taps.last_weight = static_cast<double>(at % unit) / static_cast<double>(unit);
  taps.first_weight = 1 - taps.last_weight;
  return taps;
}

bool has_hole(const float* row, std::size_t n) {
  int holes = 0;
  for (std::size_t i = 0; i < n; ++i) holes |= row[i] != row[i];
  return holes != 0;
}

double combine(const Taps& taps, const double* values) {
  values += taps.first;
  const int last = taps.count - 1;
  double sum = taps.first_weight * values[0];
  for (int k = 1; k < last; ++k) sum += taps.inner_weight * values[k];
  if (last > 0) sum += taps.last_weight * values[last];
  return sum;
}

void check_size(int width, int depth) {
  if (width < 1 || depth < 1) {
    throw usage_error(fmt::format("width and depth must be at least 1, got {} and {}", width, depth),
                      "resample", "choose the number of samples along both sides");
  }
  const std::uint64_t samples = std::uint64_t(width) * std::uint64_t(depth);
  if (samples > kMostSamples) {
    throw usage_error(fmt::format("{} × {} samples are {:.0f} million, more than the {:.0f} million allowed",
                                  width, depth, samples / 1e6, kMostSamples / 1e6),
                      "resample", "choose fewer");
  }
  require_memory(samples * sizeof(float), fmt::format("{} × {} samples", width, depth), "choose fewer");
}

// The heights that the taps combine, with the field's georeference. The caller sets the cells.
Heightfield combined(const Heightfield& field, const std::vector<Taps>& columns,
                     const std::vector<Taps>& rows) {
  const auto width = static_cast<int>(columns.size()), depth = static_cast<int>(rows.size());
  Heightfield out = Heightfield::zeros(width, depth);
  out.georeference = field.georeference;
  tbb::parallel_for(tbb::blocked_range<int>(0, depth, 8), [&](const tbb::blocked_range<int>& range) {
    RowAccumulator accumulator(field.width);
    for (int j = range.begin(); j < range.end(); ++j) {
      accumulator.clear();
      for (int y = rows[j].first; y <= rows[j].last(); ++y) {
        accumulator.add(field.heights.data() + static_cast<std::size_t>(y) * field.width, rows[j].weight(y));
      }
      accumulator.finish(columns, out.heights.data() + static_cast<std::size_t>(j) * width);
    }
  });
  return out;
}

// The distance of `to` samples over the length of `from`. Rounded so that the far border stays inside.
float gridline_cell(float cell, int from, int to) {
  if (to == 1) return cell;
  const auto last = static_cast<float>(to - 1);
  const float length = static_cast<float>(from - 1) * cell;
  float out = length / last;
  while (last * out < length) out = std::nextafter(out, HUGE_VALF);
  return out;
}

}  // namespace

std::vector<Taps> resampling_taps(int from, int to) {
  std::vector<Taps> taps(static_cast<std::size_t>(to));
  for (int k = 0; k < to; ++k) taps[k] = to < from ? area_taps(from, to, k) : linear_taps(from, to, k);
  return taps;
}

std::vector<Taps> gridline_taps(int from, int to) {
  std::vector<Taps> taps(static_cast<std::size_t>(to));
  for (int k = 0; k < to; ++k) taps[k] = gridline_taps_at(from, to, k);
  return taps;
}

void RowAccumulator::add(const float* row, double weight) {
  double* const sums = sums_.data();
  const std::size_t n = sums_.size();
  if (total_ == 0) std::fill_n(sums, n, 0.0);
  if (!holed_ && has_hole(row, n)) {
    // All columns had the same weight so far.
    weights_.assign(n, total_);
    holed_ = true;
  }
  total_ += weight;
  if (!holed_) {
    for (std::size_t i = 0; i < n; ++i) sums[i] += weight * row[i];
    return;
  }
  double* const weights = weights_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const bool has = row[i] == row[i];
    sums[i] += has ? weight * row[i] : 0;
    weights[i] += has ? weight : 0;
  }
}

void RowAccumulator::finish(const std::vector<Taps>& columns, float* row) const {
  if (!holed_) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      row[i] = static_cast<float>(combine(columns[i], sums_.data()));
    return;
  }
  // Half the weight is enough; the tolerance keeps rounding from deciding.
  constexpr double kEnough = 0.5 - 1e-9;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double weight = combine(columns[i], weights_.data());
    row[i] = weight >= kEnough ? static_cast<float>(combine(columns[i], sums_.data()) / weight)
                               : Heightfield::kNoData;
  }
}

Heightfield resample(const Heightfield& field, int width, int depth) {
  check_size(width, depth);
  if (field.width == width && field.depth == depth) return field;
  const double ratio_x = static_cast<double>(field.width) / width,
               ratio_z = static_cast<double>(field.depth) / depth;
  Heightfield out = combined(field, resampling_taps(field.width, width), resampling_taps(field.depth, depth));
  out.cell_x = static_cast<float>(field.cell_x * ratio_x);
  out.cell_z = static_cast<float>(field.cell_z * ratio_z);
  for (const int k : {1, 4}) out.georeference.transform[k] *= ratio_x;
  for (const int k : {2, 5}) out.georeference.transform[k] *= ratio_z;
  return out;
}

Heightfield resample_gridline(const Heightfield& field, int width, int depth) {
  check_size(width, depth);
  if (field.width == width && field.depth == depth) return field;
  if ((field.width == 1) != (width == 1) || (field.depth == 1) != (depth == 1)) {
    throw usage_error(fmt::format("{} × {} samples cannot cover the rectangle of {} × {}", width, depth,
                                  field.width, field.depth),
                      "resample", "choose at least 2 samples along each side, and 1 where the ground has 1");
  }
  Heightfield out = combined(field, gridline_taps(field.width, width), gridline_taps(field.depth, depth));
  out.cell_x = gridline_cell(field.cell_x, field.width, width);
  out.cell_z = gridline_cell(field.cell_z, field.depth, depth);
  // The transform places the corners of cells, half a cell before their samples.
  const double ratio_x = width == 1 ? 1 : (field.width - 1.0) / (width - 1.0),
               ratio_z = depth == 1 ? 1 : (field.depth - 1.0) / (depth - 1.0);
  std::array<double, 6>& t = out.georeference.transform;
  for (const std::size_t k : {0U, 3U}) {
    t[k] += 0.5 * ((1 - ratio_x) * t[k + 1] + (1 - ratio_z) * t[k + 2]);
    t[k + 1] *= ratio_x;
    t[k + 2] *= ratio_z;
  }
  return out;
}

}  // namespace terrabench
