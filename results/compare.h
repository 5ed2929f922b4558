// Two results folders, metric by metric: what changed, and whether it is more than noise.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/statistics.h"
#include "results/store.h"

namespace terrabench {

enum class Change {
  kSame,        // exact and equal, or a timing whose ratio's interval holds 1
  kRose,        // the ratio's interval lies above 1
  kFell,        // … below 1
  kDiffers,     // exact, and not equal
  kUnresolved,  // a timing with one sample on a side: no interval to judge by
  kOnlyBefore,
  kOnlyAfter,
};
std::string_view name(Change);

struct MetricChange {
  std::string experiment, case_name, profile, metric, unit;
  Change change = Change::kSame;
  double before = 0, after = 0;  // medians
  Summary ratio;                 // after ÷ before, when both are there
  bool same_ground = true;       // seed, parameters and terrain are those of before
};

struct Comparison {
  std::vector<MetricChange> metrics;  // in the order of the first folder, then what only the second has
  bool exact_equal() const;           // no exact metric differs
};

// Throws bad_input when a folder holds no results.
Comparison compare(const std::filesystem::path& before, const std::filesystem::path& after);
Comparison compare(const Store& before, const Store& after);

std::string compare_text(const Comparison&, bool colour);
std::string compare_json(const Comparison&);

}  // namespace terrabench
