// Separable resampling of height grids: linear between samples where the new grid is finer, the exact average
// over the new cell's area where it is coarser, along each axis separately. Every sample represents a cell
// around it, so that the new grid covers the same ground and an exact reduction keeps the mean.
//
// Holes: a weight is carried beside each sum, and a new sample whose cell is more than half without data has
// none.
#pragma once

#include <cstddef>
#include <vector>

namespace terrabench {

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
std::vector<Taps> resampling_taps(int from, int to);

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
