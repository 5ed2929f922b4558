// The ledger: every claim with what the paper says, what was measured, the verdict and where the numbers come
// from, as a page of its own. The report's other pages show parts of it in more detail.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/claims/judge.h"
#include "results/report/document.h"
#include "results/store/store.h"

namespace terrabench {

// Where rows may point, all relative to the report's folder.
struct LedgerLinks {
  std::set<std::string> pictures = {};            // files
  std::set<std::string, std::less<>> shown = {};  // ids of the tables and plots that the report contains
};

// One row per claim and sub-row, in the papers' order; the id of a row is its anchor.
Table ledger_table(const Store&, const JudgedResults&, std::span<const Paper>, const LedgerLinks&);
// The page: counts, the statements of each paper by group, and all rows with a field that filters them.
Document ledger(const Store&, const JudgedResults&, std::span<const Paper>, const LedgerLinks&);

}  // namespace terrabench
