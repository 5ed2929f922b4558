// Which method is best at what on which ground, in tables: a row per question, a column per ground. Made from
// rankings; README.md, the report and the terminal show the same ones.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/claims/ranking.h"
#include "results/report/advice.h"
#include "results/report/document.h"

namespace terrabench {

// A table per name of RankingLayout::table, in the order of first use, of the rankings that have one. In a
// cell stands the best method with its lead over the next, "ROAM 1.78 ×", those that are tied, "drills ≈
// stacks", or those of which one may be the best, "CBT or RTIN"; a link leads to the ground's page. The last
// column says on how many of the grounds a method is best. A dagger marks cells of which `elsewhere` has an
// answer, and none of its methods is among the best here.
std::vector<Table> findings_tables(std::span<const Ranking>, std::span<const Answer> elsewhere = {});

// A line per headline: the question, and "ROAM on 3 of 3 grounds".
Facts headlines(std::span<const Ranking>);

// The table for a terminal: aligned columns, no caption. Texts longer than `widest` characters are wrapped.
std::string plain_text(const Table&, std::size_t widest = 100);

}  // namespace terrabench
