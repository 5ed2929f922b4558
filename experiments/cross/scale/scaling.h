// Costs against the size of the ground: which sizes a budget allows, and the power law through what was
// measured. Sizes are counted in columns, the samples of a height map or side² of a solid's lattice.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/recorder.h"

namespace terrabench::cross {

// smallest, then each about twice the one before, as grids of 2^k + 1 samples are; up to `largest`, which is
// included if it is met. Both ≥ 2.
std::vector<int> doubled_sides(int smallest, int largest);
// smallest, 3/2 and 2 times that, 3 and 4 times that, and so on, where these are whole.
std::vector<int> half_octave_sides(int smallest, int largest);

// For one kind of work, over all sizes.
struct Budget {
  double seconds = 0;
  std::uint64_t bytes = 0;  // largest heap
};

// How the work grows in theory: exponents of the number of columns.
struct Growth {
  double time = 1, memory = 1;
};

// Admits sizes, in ascending order, while the budget lasts. What the next size takes is estimated from the
// last one measured and from the theory; the first size is always admitted. A size that is not measured is
// recorded with the reason, and the larger ones are not tried.
class SizePlan {
 public:
  SizePlan(std::string name, Budget budget, Growth growth)
      : name_(std::move(name)), budget_(budget), growth_(growth) {}

  bool admits(double columns);
  // The peak of the heap at this size, from that of the last size and the theory; 0 before the first.
  std::uint64_t expected_bytes(double columns) const;
  void measured(double columns, double seconds, std::int64_t peak_bytes);
  // The structure does not take ground of this size.
  void refused() { ++refused_; }

  // The numbers of sizes skipped: name_short_of_time, name_short_of_memory and name_refused.
  void record(Recorder&) const;

  std::size_t sizes() const { return sizes_; }

 private:
  std::string name_;
  Budget budget_;
  Growth growth_;
  std::size_t sizes_ = 0, short_of_time_ = 0, short_of_memory_ = 0, refused_ = 0;
  double last_columns_ = 0, last_seconds_ = 0, spent_ = 0;
  double last_peak_ = 0;
};

// One cost at all sizes, each measured once or more.
class Cost {
 public:
  // `theory`: exponent of the number of columns, where one is stated; `logarithm`: times the logarithm of
  // that number.
  Cost(std::string name, std::string unit, std::optional<double> theory, bool logarithm = false)
      : name_(std::move(name)), unit_(std::move(unit)), theory_(theory), logarithm_(logarithm) {}

  void add(double columns, double value) {
    columns_.push_back(columns);
    values_.push_back(value);
  }

  // The samples as `name`, their sizes as name_columns, pair by pair; name_smallest and name_largest, the
  // range of sizes; name_theory, the exponent in theory, if there is one; and from two sizes on
  // name_exponent, the exponent of the power law through the medians of the sizes, name_excess, that minus
  // the theory, and name_fitted, the number of sizes. From three sizes on name_low and name_high, the
  // exponent's 95 % interval. Where the median of a size is 0, as of uploaded bytes it may be, there is no
  // exponent. Throws environment_error where a time is 0: then nothing was measured.
  void record(Recorder&) const;

  // In theory, over the sizes measured: with the logarithm the slope depends on them.
  std::optional<double> theory() const;

 private:
  std::string name_, unit_;
  std::optional<double> theory_;
  bool logarithm_;
  std::vector<double> columns_, values_;
};

}  // namespace terrabench::cross
