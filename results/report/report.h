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
  std::string advice = {};               // which method for each further ground, likewise
};

struct ReportOptions {
  const Store* reference =
      nullptr;               // with whose grounds further ones are compared; null: the reference run's
  std::string purpose = {};  // whose questions are answered for further grounds (advice.h); empty: all
};

// DIR/report/: index.html, report.md, and pages in both forms: paper-*, ground-*, ledger, findings,
// wrong-or-vague, runs, other; tables/*.csv, figures/*.svg of plots; pictures are shown where they lie, in
// DIR/figures/. Replaces an earlier report as a whole or not at all; equal measurements give equal bytes.
// Throws bad_input when the folder holds no results, environment_error when `report` in it is no earlier
// report, or when the report cannot be written. Not thread-safe. `reference`: a results folder, or none.
// `profile`: as Store::open().
WrittenReport write_report(const std::filesystem::path& folder, const std::filesystem::path& reference = {},
                           const std::string& profile = "", const std::string& purpose = "");
WrittenReport write_report(const Store&, std::span<const Paper>, const ReportOptions& options = {});

}  // namespace terrabench
