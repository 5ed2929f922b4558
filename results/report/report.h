// Writes the pages, tables and figures of a results folder, complete or partial. Takes seconds; measures
// nothing.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

struct WrittenReport {
  std::filesystem::path page;            // index.html
  std::vector<std::string> faults = {};  // why its results cannot be trusted; empty if they can
  std::string findings = {};             // the tables of findings, for a terminal
};

// DIR/report/: index.html, report.md, and pages in both forms: paper-*, ground-*, ledger, findings,
// wrong-or-vague, runs, other; tables/*.csv, figures/*.svg of plots; pictures are shown where they lie, in
// DIR/figures/. Replaces an earlier report as a whole or not at all; equal measurements give equal bytes.
// Throws bad_input when the folder holds no results, environment_error when `report` in it is no earlier
// report, or when the report cannot be written. Not thread-safe. `reference`: another results folder, with
// whose grounds further ones are compared (further_grounds.h); by default the same folder. `profile`: as
// Store::open().
WrittenReport write_report(const std::filesystem::path& folder, const std::filesystem::path& reference = {},
                           const std::string& profile = "");
WrittenReport write_report(const Store&, std::span<const Paper>, const Store* reference = nullptr);

}  // namespace terrabench
