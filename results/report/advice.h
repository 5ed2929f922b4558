// Which method to take for a ground: a row per RankingLayout::question, with the reason in numbers, and
// whether the reference grounds have the same answer. The report and the terminal show the same table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/claims/ranking.h"
#include "results/report/table.h"

namespace terrabench {

// Which methods are best at a question on a ground, by name; several if they are tied, none if it is not
// decided.
struct Answer {
  const RankingLayout* layout;
  std::vector<std::string> best;
};
// Of rankings with a question. Their layouts must outlive the answers.
std::vector<Answer> answers(std::span<const Ranking>);
// Of the reference run, results/reference/report/findings.json, which is compiled in.
std::span<const Answer> reference_answers();

// Whether the ranking's question matters for the purpose (empty: for any).
bool matters(const RankingLayout&, std::string_view purpose);
// The purposes that the claims files name, and the experiments that answer their questions on a ground that
// no claims file names.
std::vector<std::string> purposes();
std::vector<std::string> experiments_for(std::string_view purpose);

// Question, take, next, lead, reference, why. Without id and title.
Table advice(std::span<const Ranking> here, std::span<const Answer> elsewhere);
// For a terminal: the table, then a line per reason.
std::string advice_text(const Table&);

}  // namespace terrabench
