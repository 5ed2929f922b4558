#include "representations/coding/height_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "representations/coding/range_coder.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr std::int32_t kMostSteps = 1 << 30;  // differences fit 32 bits

struct Range {
  double lowest = 0, highest = 0;
  bool any = false, holes = false;
};

Range range_of(std::span<const float> heights) {
  Range range;
  for (const float h : heights) {
    if (std::isnan(h)) {
      range.holes = true;
      continue;
    }
    range.lowest = range.any ? std::min<double>(range.lowest, h) : h;
    range.highest = range.any ? std::max<double>(range.highest, h) : h;
    range.any = true;
  }
  return range;
}

// Whether all heights lie a whole number of units above the lowest, up to the rounding of floats.
bool multiples_of(double unit, std::span<const float> heights, const Range& range) {
  const double rounding = 0x1p-22 * std::max(std::abs(range.lowest), std::abs(range.highest));
  if (rounding > 0.25 * unit) return false;
  return std::ranges::all_of(heights, [&](float h) {
    const double units = (h - range.lowest) / unit;
    return std::isnan(h) || std::abs(units - std::round(units)) * unit <= rounding;
  });
}

// A row of numbers with a margin on both sides, so that no neighbour needs a test.
template <class T>
class MarginRow {
 public:
  static constexpr int kMargin = 2;
  explicit MarginRow(int width) : values_(static_cast<std::size_t>(width + 2 * kMargin)) {}
  T& operator[](int i) { return values_[static_cast<std::size_t>(i + kMargin)]; }
  // Beyond the ends, the outermost numbers again.
  void fill_margins(int width) {
    for (int k = 1; k <= kMargin; ++k) {
      (*this)[-k] = (*this)[0];
      (*this)[width - 1 + k] = (*this)[width - 1];
    }
  }

 private:
  std::vector<T> values_;
};

constexpr int kPredictors = 6;
using Guesses = std::array<float, kPredictors>;

// Codes row after row. Every part runs alike in both directions.
template <class Coder>
class HeightCoder {
 public:
  HeightCoder(Coder& coder, int width, bool holes)
      : coder_(coder),
        width_(width),
        holes_(holes),
        rows_{MarginRow<std::int32_t>(width), MarginRow<std::int32_t>(width), MarginRow<std::int32_t>(width)},
        misses_{MarginRow<Guesses>(width), MarginRow<Guesses>(width)},
        residuals_{MarginRow<std::int32_t>(width), MarginRow<std::int32_t>(width)},
        absent_{MarginRow<std::uint8_t>(width), MarginRow<std::uint8_t>(width)} {}

  // `steps`: of each sample; `absent`: 1 for no data. Both are read by an encoder, written by a decoder.
  void row(std::span<std::int32_t> steps, std::span<std::uint8_t> absent) {
    auto &here = rows_[0], &north = rows_[1];
    for (int i = 0; i < width_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (holes_) absent[at] = absent_[0][i] = code_absent(i, absent[at]);
      // The margin to the west, which the row itself has not filled yet, and where there is no data: as if
      // the ground went on level.
      if (i == 0) here[-1] = here[-2] = north[0];
      if (holes_ && absent[at] != 0) {
        here[i] = here[i - 1];
        residuals_[0][i] = 0;
        misses_[0][i] = {};
        continue;
      }
      const Guesses guesses = guess(i);
      const auto predicted =
          static_cast<std::int32_t>(std::clamp<long>(std::lround(blend(guesses, i)), 0, kMostSteps));
      const std::int32_t residual = number_[surroundings(i)].code(coder_, steps[at] - predicted);
      // Damaged files hold residuals of any size.
      const std::int64_t value = std::clamp<std::int64_t>(std::int64_t{predicted} + residual, 0, kMostSteps);
      steps[at] = here[i] = static_cast<std::int32_t>(value);
      residuals_[0][i] = std::min(std::abs(residual), 1 << 24);
      for (int k = 0; k < kPredictors; ++k) {
        const auto p = static_cast<std::size_t>(k);
        misses_[0][i][p] = std::abs(guesses[p] - static_cast<float>(here[i]));
      }
    }
    here.fill_margins(width_);
    misses_[0].fill_margins(width_);
    residuals_[0].fill_margins(width_);
    absent_[0].fill_margins(width_);
    std::rotate(rows_.begin(), rows_.end() - 1, rows_.end());
    std::swap(misses_[0], misses_[1]);
    std::swap(residuals_[0], residuals_[1]);
    std::swap(absent_[0], absent_[1]);
  }

 private:
  std::uint8_t code_absent(int i, std::uint8_t value) {
    auto &here = absent_[0], &north = absent_[1];
    if (i == 0) here[-1] = north[0];
    const auto context =
        static_cast<std::size_t>(here[i - 1] | north[i - 1] << 1 | north[i] << 2 | north[i + 1] << 3);
    return code_bit(coder_, absent_model_[context], value != 0) ? 1 : 0;
  }

  Guesses guess(int i) {
    const auto number = [](std::int32_t n) { return static_cast<float>(n); };
    const float w = number(rows_[0][i - 1]), ww = number(rows_[0][i - 2]), n = number(rows_[1][i]),
                nw = number(rows_[1][i - 1]), ne = number(rows_[1][i + 1]), nn = number(rows_[2][i]),
                nne = number(rows_[2][i + 1]);
    return {w + n - nw, std::clamp(w + n - nw, std::min(w, n), std::max(w, n)),
            w + ne - n, 2 * n - nn,
            2 * w - ww, n + ne - nne};
  }

  // Each guess weighs as much as it was right around here.
  float blend(const Guesses& guesses, int i) {
    float sum = 0, weights = 0;
    for (std::size_t k = 0; k < kPredictors; ++k) {
      const float west = misses_[0][i - 1][k], north = misses_[1][i][k], north_west = misses_[1][i - 1][k],
                  north_east = misses_[1][i + 1][k];
      const float miss =
          0.5F + west * west + north * north + 0.5F * (north_west * north_west + north_east * north_east);
      const float weight = 1 / (miss * miss);
      sum += weight * guesses[k];
      weights += weight;
    }
    return weights > 0 && std::isfinite(sum) ? sum / weights : guesses[0];
  }

  // How rough the ground is around here: the number of binary digits of the residuals.
  std::size_t surroundings(int i) {
    auto &here = residuals_[0], &north = residuals_[1];
    const std::int32_t sum = 2 * here[i - 1] + 2 * north[i] + north[i - 1] + north[i + 1];
    return std::min<std::size_t>(std::bit_width(static_cast<std::uint32_t>(sum)), kContexts - 1);
  }

  static constexpr std::size_t kContexts = 20;

  Coder& coder_;
  int width_;
  bool holes_;
  std::array<MarginRow<std::int32_t>, 3> rows_;  // this one and the two to the north
  std::array<MarginRow<Guesses>, 2> misses_;
  std::array<MarginRow<std::int32_t>, 2> residuals_;  // magnitudes
  std::array<MarginRow<std::uint8_t>, 2> absent_;
  std::array<NumberModel, kContexts> number_;
  std::array<BitModel, 16> absent_model_;
};

}  // namespace

double step_for(std::span<const float> heights, double largest_error) {
  const Range range = range_of(heights);
  double step = std::max(2 * largest_error, 0x1p-20 * (range.highest - range.lowest));
  for (const double unit : {1.0, 0.1, 0.01}) {
    if (!multiples_of(unit, heights, range)) continue;
    step = std::max(2 * largest_error, (2 * std::floor(largest_error / unit) + 1) * unit);
    break;
  }
  return step > 0 ? std::max(step, (range.highest - range.lowest) / kMostSteps) : 1;
}

void encode_heights(std::span<const float> heights, int width, double step, ByteSink& out) {
  const Range range = range_of(heights);
  step = std::max(step, (range.highest - range.lowest) / kMostSteps);
  RangeEncoder coder;
  HeightCoder<RangeEncoder> rows(coder, width, range.holes);
  const auto columns = static_cast<std::size_t>(width);
  std::vector<std::int32_t> steps(columns);
  std::vector<std::uint8_t> absent(columns);
  for (std::size_t first = 0; first < heights.size(); first += columns) {
    for (std::size_t i = 0; i < columns; ++i) {
      const float h = heights[first + i];
      absent[i] = std::isnan(h) ? 1 : 0;
      steps[i] = absent[i] != 0 ? 0 : static_cast<std::int32_t>(std::lround((h - range.lowest) / step));
    }
    rows.row(steps, absent);
  }
  const std::vector<std::byte> coded = coder.finish();
  out.put(step);
  out.put(range.lowest);
  out.put(static_cast<std::uint8_t>(range.holes));
  out.put(static_cast<std::uint64_t>(coded.size()));
  out.put_array(std::span<const std::byte>(coded));
}

std::vector<float> decode_heights(ByteSource& in, int width, int depth) {
  const auto step = in.get<double>(), lowest = in.get<double>();
  const auto holes = in.get<std::uint8_t>();
  if (!(step > 0) || !std::isfinite(step) || !std::isfinite(lowest) || holes > 1) {
    in.fail("the heights' step or lowest value is impossible");
  }
  const std::vector<std::byte> coded = in.get_array<std::byte>(in.get<std::uint64_t>());
  RangeDecoder coder(coded, in);
  HeightCoder<RangeDecoder> rows(coder, width, holes == 1);
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(depth);
  if (count > available_memory() / sizeof(float)) in.fail("more heights than fit the memory");
  std::vector<float> heights;
  heights.reserve(count);
  std::vector<std::int32_t> steps(static_cast<std::size_t>(width));
  std::vector<std::uint8_t> absent(static_cast<std::size_t>(width));
  for (int j = 0; j < depth; ++j) {
    rows.row(steps, absent);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      heights.push_back(absent[i] != 0 ? std::numeric_limits<float>::quiet_NaN()
                                       : static_cast<float>(lowest + steps[i] * step));
    }
  }
  if (!coder.at_end()) in.fail("bytes follow the last height");
  return heights;
}

void clamp_heights(std::span<float> heights, float lowest, float highest) {
  for (float& h : heights) {
    if (!std::isnan(h)) h = std::clamp(h, lowest, highest);
  }
}

}  // namespace terrabench
