// Separable resampling of height grids, in two registrations.
//
// Of cells (resample(), heightfield.h): every sample represents a cell around it, so that the new grid covers
// the same cells and an exact reduction keeps the mean. Linear between samples where the new grid is finer,
// the exact average over the new cell's area where it is coarser, along each axis separately.
//
// Of grid lines (resample_gridline()): samples are points of a lattice over one rectangle. The outermost stay
// where they are, and a new sample is the bilinear height at its own place.
//
// Holes: a weight is carried beside each sum, and a new sample whose cell is more than half without data has
// none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/heightfield.h"

namespace terrabench {

// The most samples of a height field that is read whole or resampled: 1 GiB.
inline constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 28;

// The same rectangle at another number of samples: each is the bilinear height at its own (i·cell_x,
// j·cell_z) of the given field, so that the two can be compared place by place. resample() moves them: its
// sample (0, 0) stands in the middle of the new grid's first cell, which only the georeference says. Throws
// usage_error unless each side has at least 2 samples, or 1 in both fields, and for more than kMostSamples;
// environment_error, before anything is taken, where memory does not suffice. O(n).
Heightfield resample_gridline(const Heightfield&, int width, int depth);

// The source samples that make one new sample along one axis; the weights add up to 1.
struct Taps {
  int first = 0, count = 1;
  double first_weight = 1, inner_weight = 0, last_weight = 0;  // count == 1: first_weight alone

  int last() const { return first + count - 1; }
  double weight(int source) const {
    return source == first ? first_weight : source == last() ? last_weight : inner_weight;
  }
};

// Taps of `to` new samples over `from` old ones. O(to).
std::vector<Taps> resampling_taps(int from, int to);  // of cells
std::vector<Taps> gridline_taps(int from, int to);    // of points; both 1 or both more

// Makes one new row from weighted old rows. Rows are summed first, which vectorises; columns once per new
// row. Holds 8 bytes per old column, and 8 more once it met a hole.
class RowAccumulator {
 public:
  explicit RowAccumulator(int width) : sums_(static_cast<std::size_t>(width)) {}

  void clear() {
    total_ = 0;
    holed_ = false;
  }
  void add(const float* row, double weight);  // as many heights as there are old columns
  void finish(const std::vector<Taps>& columns,
              float* row) const;  // as many heights as there are new columns

 private:
  std::vector<double> sums_, weights_;
  double total_ = 0;    // weight of all rows added so far
  bool holed_ = false;  // a row had a hole: weights_ holds the weight of each column
};

}  // namespace terrabench
