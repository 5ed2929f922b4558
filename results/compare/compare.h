// Compares two results folders metric by metric, and picture by picture (compare_pictures.h).
// Exact figures must be equal on any two machines; what varies (timed() in record.h) is compared within one
// kind of machine.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "results/compare/compare_pictures.h"
#include "results/store/statistics.h"
#include "results/store/store.h"

namespace terrabench {

enum class Change {
  kSame,        // exact and equal, or a timing for which relation() (statistics.h) is a tie
  kRose,        // a timing that is larger by relation()
  kFell,        // or smaller
  kDiffers,     // exact and not equal
  kUnresolved,  // a timing for which relation() is undecided, or without a finite ratio
  kElsewhere,   // a timing of another kind of machine, which says nothing about the code
  kOnlyBefore,
  kOnlyAfter,
};
std::string_view name(Change);

struct MetricChange {
  std::string experiment, case_name, profile, metric, unit;
  Change change = Change::kSame;
  bool timed = false;                                   // a time, or computed from times
  double before = 0, after = 0;                         // medians
  Summary ratio = {};                                   // after ÷ before, when both exist
  bool same_ground = true;                              // both have the same seed, parameters and terrain
  std::string machine_before = "", machine_after = "";  // machine_name(), where they are of different kinds

  bool one_sided() const;
};

struct Comparison {
  std::vector<MetricChange> metrics;  // in the first folder's order, then those that only the second has
  std::vector<std::string> warnings, faults;  // of both stores
  // Of after ÷ before, over all timings of one kind of machine with an interval; NaN if there are none. What
  // all share, such as a busy hour of the machine, makes all seem changed.
  double median_ratio = NAN;
  PictureComparison pictures;

  bool exact_equal() const;  // no exact metric differs
  bool passed() const { return exact_equal() && pictures.passed() && faults.empty(); }
  std::size_t count(Change) const;
};

// Throws bad_input when a folder holds no results, and when the two have nothing in common, such as one of
// the paper profile and one of the quick one.
Comparison compare(const std::filesystem::path& before, const std::filesystem::path& after,
                   const PictureLimits& = {});
Comparison compare(const Store& before, const Store& after, const PictureLimits& = {});

// A summary first; then what only one folder has, counted by experiment, and the metrics that changed. `all`:
// a line for every metric instead.
std::string compare_text(const Comparison&, bool colour, bool all = false);
std::string compare_json(const Comparison&);

}  // namespace terrabench
