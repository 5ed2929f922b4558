// Cases that were not measured and metrics that have no value, grouped by their reason: what `run` lists at
// its end, `check` before its summary, and the report as a table.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/store/record.h"

namespace terrabench {

struct Absence {
  std::string what;                // "failed", "skipped" or "not defined"
  std::string reason;              // as recorded
  std::vector<std::string> where;  // "experiment case", and the metrics where those alone have no value
};
// Failed cases first, then skipped ones, then metrics that are not defined, each in the records' order. O(n
// log n) for n records.
std::vector<Absence> absences(std::span<const Record* const>);

// "failed (2 cases): REASON", and under it a line per case; all of them, or the first few and how many more.
std::string absences_text(std::span<const Absence>, bool all);

}  // namespace terrabench
