// The statements of one group of a paper as a referee lists them: where it stands, what was measured, whether
// it holds and why not; and what every row of the ledger shows of its verdict.
#pragma once

#include <string>

#include "results/claims/statements.h"
#include "results/report/table.h"

namespace terrabench {

// One row per statement; without rows if the group has none. Ids link to the anchors `#ID` of the same page.
Table statement_table(const JudgedResults&, const Paper&, Group);

// The figure that decides and, of a claim with several conditions, which one it is of and why; with its
// bound, unless the claim words its tolerance.
std::string decided_by(const Judgement&);
// Why the verdict is not “reproduced”; empty if it is.
std::string why_not(const Judgement&);
Cell standing_cell(const Statement&);

}  // namespace terrabench
