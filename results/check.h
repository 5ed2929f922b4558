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
  std::vector<std::string> warnings, faults;  // of the store

  bool passed() const;  // no complaint, no fault
};

// Claims must outlive the report. Throws bad_input when the folder holds no results.
CheckReport check(const std::filesystem::path& folder);
CheckReport check(const Store&, std::span<const Paper>);

// For terminals, programs and continuous integration.
std::string check_text(const CheckReport&, bool colour);
std::string check_json(const CheckReport&);
std::string check_junit(const CheckReport&);

}  // namespace terrabench
