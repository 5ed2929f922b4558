// Counts of verdicts, apart for each kind of row: what is about a paper, our own rules, identities, repeats.
#pragma once

#include <map>
#include <span>
#include <string>

#include "results/judge.h"

namespace terrabench {

// The order of verdicts in tables: first what was measured.
inline constexpr Verdict kVerdictColumns[] = {Verdict::kReproduced,    Verdict::kShape,   Verdict::kDiffers,
                                              Verdict::kNotComparable, Verdict::kMissing, Verdict::kNotRun,
                                              Verdict::kPending};

// Both without empty entries, in the order of their enumerations.
using VerdictCounts = std::map<Verdict, int>;
std::map<About, VerdictCounts> tally(std::span<const Judgement>);

// "3 reproduced, 2 pending".
std::string counts_text(const VerdictCounts&);

}  // namespace terrabench
