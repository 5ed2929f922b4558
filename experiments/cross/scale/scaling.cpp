#include "experiments/cross/scale/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "results/store/power_law.h"
#include "results/store/statistics.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

// The medians of the samples of each size, in ascending order of size.
struct Medians {
  std::vector<double> columns, values;
};

Medians medians_of(const std::vector<double>& columns, const std::vector<double>& values) {
  std::map<double, std::vector<double>> by_size;
  for (std::size_t i = 0; i < columns.size(); ++i) by_size[columns[i]].push_back(values[i]);
  Medians medians;
  for (const auto& [size, samples] : by_size) {
    medians.columns.push_back(size);
    medians.values.push_back(summarise(samples).median);
  }
  return medians;
}

}  // namespace

std::vector<int> doubled_sides(int smallest, int largest) {
  std::vector<int> sides;
  for (std::int64_t side = smallest; side <= largest; side = 2 * side - 1) {
    sides.push_back(static_cast<int>(side));
  }
  return sides;
}

std::vector<int> half_octave_sides(int smallest, int largest) {
  std::vector<int> sides;
  for (std::int64_t side = smallest; side <= largest; side *= 2) {
    sides.push_back(static_cast<int>(side));
    if (side % 2 == 0 && side / 2 * 3 <= largest) sides.push_back(static_cast<int>(side / 2 * 3));
  }
  return sides;
}

bool SizePlan::admits(double columns) {
  if (refused_ > 0) {
    ++refused_;
    return false;
  }
  if (sizes_ == 0) return true;
  const double ratio = columns / last_columns_;
  if (expected_bytes(columns) > budget_.bytes) {
    ++short_of_memory_;
    return false;
  }
  if (spent_ + last_seconds_ * std::pow(ratio, growth_.time) > budget_.seconds) {
    ++short_of_time_;
    return false;
  }
  return true;
}

std::uint64_t SizePlan::expected_bytes(double columns) const {
  if (sizes_ == 0) return 0;
  constexpr double kEnough = 1e18;  // larger than any memory, and still an integer
  return static_cast<std::uint64_t>(
      std::min(kEnough, last_peak_ * std::pow(columns / last_columns_, growth_.memory)));
}

void SizePlan::measured(double columns, double seconds, std::int64_t peak_bytes) {
  ++sizes_;
  last_columns_ = columns;
  last_seconds_ = seconds;
  spent_ += seconds;
  last_peak_ = static_cast<double>(std::max<std::int64_t>(peak_bytes, 0));
}

void SizePlan::record(Recorder& recorder) const {
  recorder.add_varying(name_ + "_short_of_time", "", static_cast<double>(short_of_time_));
  recorder.add_varying(name_ + "_short_of_memory", "", static_cast<double>(short_of_memory_));
  recorder.add_varying(name_ + "_refused", "", static_cast<double>(refused_));
}

std::optional<double> Cost::theory() const {
  if (!theory_ || !logarithm_ || columns_.empty()) return theory_;
  // The exponent of n^theory · log n between the smallest and the largest size.
  const auto [low, high] = std::minmax_element(columns_.begin(), columns_.end());
  if (!(*low > 1 && *high > *low)) return theory_;
  return *theory_ + std::log(std::log(*high) / std::log(*low)) / std::log(*high / *low);
}

// How many sizes are measured depends on the time that they take, so all that is computed over them varies.
void Cost::record(Recorder& recorder) const {
  if (columns_.empty()) return;
  // An exponent of times varies from run to run as they do.
  const std::string_view unit = is_timing(unit_) ? "exponent" : "";
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    recorder.add_varying(name_, unit_, values_[i]);
    recorder.add_varying(name_ + "_columns", "", columns_[i]);
  }
  const auto [low, high] = std::minmax_element(columns_.begin(), columns_.end());
  recorder.add_varying(name_ + "_smallest", "", *low);
  recorder.add_varying(name_ + "_largest", "", *high);
  const std::optional<double> expected = theory();
  if (expected) recorder.add_varying(name_ + "_theory", "", *expected);
  const Medians medians = medians_of(columns_, values_);
  for (std::size_t i = 0; i < medians.values.size(); ++i) {
    if (unit_ == "s" && !(medians.values[i] > 0)) {
      throw environment_error(fmt::format("{} took no time at {:.0f} columns", name_, medians.columns[i]),
                              "cross.scale", "report it as a bug");
    }
  }
  const auto law = fit_power_law(medians.columns, medians.values);
  if (!law) return;
  recorder.add_varying(name_ + "_fitted", "", static_cast<double>(law->points));
  recorder.add_varying(name_ + "_exponent", unit, law->exponent);
  if (expected) recorder.add_varying(name_ + "_excess", unit, law->exponent - *expected);
  if (!std::isfinite(law->low)) return;
  recorder.add_varying(name_ + "_low", unit, law->low);
  recorder.add_varying(name_ + "_high", unit, law->high);
}

}  // namespace terrabench::cross
