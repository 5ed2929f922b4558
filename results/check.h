// The ledger's verdicts, computed from records and claims and nothing else.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "results/claims.h"
#include "results/store.h"

namespace terrabench {

struct Row {
  const Paper* paper = nullptr;
  const Claim* claim = nullptr;
  Verdict verdict = Verdict::kPending;
  std::string measured;           // what was found, condition by condition; why, when nothing was
  std::vector<std::string> runs;  // ids of the runs that it rests on
  std::string complaint;          // why `check` fails at this row; empty when it does not
};

struct CheckReport {
  std::string profile;  // the one that was run last
  std::vector<Row> rows;
  std::vector<std::string> warnings, faults;  // of the store and of the pictures that its records drew

  bool passed() const;  // no complaint, no fault
};

// Claims must outlive the report. Only rows whose id matches one of the globs (* and ?) are judged; none:
// all. Throws bad_input when the folder holds no results, usage_error when a glob matches no row.
CheckReport check(const std::filesystem::path& folder, std::span<const std::string> row_globs = {});
CheckReport check(const Store&, std::span<const Paper>, std::span<const std::string> row_globs = {});

// For terminals, programs and continuous integration.
std::string check_text(const CheckReport&, bool colour);
std::string check_json(const CheckReport&);
std::string check_junit(const CheckReport&);

}  // namespace terrabench
