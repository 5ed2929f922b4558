// "Where the papers are wrong or vague": a page made from the claims about papers that differ, and from those
// that settle what a paper leaves open. Repeats stand with the row that they repeat.
#pragma once

#include <span>
#include <string>

#include "results/document.h"
#include "results/judge.h"

namespace terrabench {

inline constexpr std::string_view kPaperFaultsTitle = "Where the papers are wrong or vague";

// How many of the measured rows about the papers differ, and of which papers, the largest share first, as one
// sentence. Empty if none was measured.
std::string where_papers_differ(const JudgedResults&, std::span<const Paper>);

// Links lead into the report's main page, `report`. Empty if no claim belongs there.
Document paper_faults(const JudgedResults&, std::span<const Paper>, const std::string& report);

}  // namespace terrabench
