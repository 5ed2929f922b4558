// What became of each statement of a paper: the verdict on its claim, and on the other readings of it. This
// is what is counted, in three groups that are never added up: what a paper states, the figures it draws, and
// what we ask beyond it.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "results/claims/judge.h"

namespace terrabench {

enum class Standing {
  kAsPrinted,     // the claim holds
  kOtherReading,  // it does not, but one of its readings does
  kDoesNotHold,   // none does
  kNotJudged,     // nothing was measured in this profile, or it cannot be compared here
};
inline constexpr Standing kStandings[] = {Standing::kAsPrinted, Standing::kOtherReading,
                                          Standing::kDoesNotHold, Standing::kNotJudged};
// "hold as printed"; of what is beyond the paper, "hold".
std::string_view name(Standing, Group);

struct Statement {
  const Judgement* claim = nullptr;
  std::vector<const Judgement*> sub_rows = {};  // in the claims' order
  Standing standing = Standing::kNotJudged;
  const Judgement* reading = nullptr;  // the first that holds, if the standing is kOtherReading
  bool everywhere = true;              // no further ground or setting that was measured differs
};

// Of the judgements of one or more papers, in their order. Sub-rows whose claim is not among them are left
// out. O(n log n).
std::vector<Statement> statements(std::span<const Judgement>);

using StandingCounts = std::array<int, std::size(kStandings)>;
// Without groups that have no statement.
std::map<Group, StandingCounts> count_standings(std::span<const Statement>);
int sum(const StandingCounts&);
// Of those of the group that hold as printed: how many do so on every further ground and in every setting.
int count_everywhere(std::span<const Statement>, Group);

// "3 hold as printed, 1 does not hold".
std::string counts_text(const StandingCounts&, Group);

}  // namespace terrabench
