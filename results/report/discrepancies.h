// "Where measurements do not confirm the papers": a page made from the statements that do not hold as
// printed, each under its cause, and from those that settle what a paper leaves open.
#pragma once

#include <span>

#include "results/claims/judge.h"
#include "results/report/document.h"

namespace terrabench {

inline constexpr std::string_view kDiscrepanciesTitle = "Where measurements do not confirm the papers";

// Links lead into the ledger. Empty if no claim belongs here.
Document discrepancies(const JudgedResults&, std::span<const Paper>);

// How many of these statements have which cause, with links to that page.
Table causes_of_differences(const JudgedResults&, std::span<const Paper>);

}  // namespace terrabench
