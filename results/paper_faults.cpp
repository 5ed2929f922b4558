#include "results/paper_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "results/fill.h"
#include "results/report_tables.h"

namespace terrabench {
namespace {

class Page {
 public:
  Page(const JudgedResults& results, const std::string& report) : results_(results), report_(report) {}

  Table differing(const Paper& paper) const {
    Table table{
        "wrong." + paper.id,
        "Read as printed, these differ",
        "What the paper says in our words, what it prints, what was measured, why it differs, and which "
        "reading matches.",
        {{"Claim"}, {"The paper"}, {"Printed"}, {"Measured as printed"}, {"Why"}, {"What matches"}},
        {}};
    for (const Judgement& j : results_.of(paper)) {
      const Claim& claim = *j.claim;
      if (j.verdict != Verdict::kDiffers || !is_own_row(j)) continue;
      table.rows.push_back({{claim.id, "", link(paper)},
                            {where_and_statement(claim)},
                            {reported_text(claim)},
                            {j.deciding.text + also_differing(paper, claim)},
                            {claim.reason()},
                            {matching(paper, claim)}});
    }
    return table;
  }

  Table vague(const Paper& paper) const {
    Table table{"vague." + paper.id,
                "The paper can be read in several ways",
                "What the paper leaves open, and what was measured under the readings.",
                {{"Claim"}, {"The paper"}, {"Left open"}, {"Measured"}, {"Verdict"}},
                {}};
    for (const Judgement& j : results_.of(paper)) {
      const Claim& claim = *j.claim;
      if (claim.vague.empty() || claim.about == About::kRepeat || !was_measured(j.verdict) || j.runs.empty())
        continue;
      table.rows.push_back({{claim.id, "", link(paper)},
                            {where_and_statement(claim)},
                            {claim.vague},
                            {claim.note.empty() ? j.measured : claim.note},
                            verdict_cell(j)});
    }
    return table;
  }

 private:
  std::string link(const Paper& paper) const { return report_ + "#" + paper.id + "-verdicts"; }

  const Judgement* find(const Paper& paper, const std::string& id) const {
    const auto all = results_.of(paper);
    const auto at = std::ranges::find_if(all, [&](const Judgement& j) { return j.claim->id == id; });
    return at == all.end() ? nullptr : &*at;
  }

  // A repeat has a row of its own only where the row that it repeats does not differ.
  bool is_own_row(const Judgement& j) const {
    if (j.claim->about == About::kPaper) return true;
    if (j.claim->about != About::kRepeat) return false;
    const Judgement* const of = find(*j.paper, j.claim->repeats);
    return of != nullptr && of->claim->about == About::kPaper && of->verdict != Verdict::kDiffers;
  }

  std::string also_differing(const Paper& paper, const Claim& claim) const {
    std::string text;
    for (const Judgement& j : results_.of(paper)) {
      if (j.claim->repeats != claim.id || j.verdict != Verdict::kDiffers) continue;
      text +=
          fmt::format("{}{} ({})", text.empty() ? ". Differs also in " : ", ", j.claim->id, j.deciding.value);
    }
    return text;
  }

  std::string matching(const Paper& paper, const Claim& claim) const {
    const Judgement* const match = find(paper, claim.matches);
    if (match == nullptr) return claim.matches;
    return fmt::format("{}, {}: {} {}", match->claim->id, name(match->verdict), match->claim->statement,
                       match->stated);
  }

  const JudgedResults& results_;
  const std::string& report_;
};

// Of the rows about a paper.
struct Share {
  std::string name;
  int differing = 0, measured = 0;
};

Share share_of(const JudgedResults& results, const Paper& paper) {
  Share share{paper.title.substr(0, paper.title.find(':'))};
  for (const Judgement& j : results.of(paper)) {
    if (j.claim->about != About::kPaper || j.verdict > Verdict::kDiffers) continue;
    ++share.measured;
    if (j.verdict == Verdict::kDiffers) ++share.differing;
  }
  return share;
}

}  // namespace

std::string where_papers_differ(const JudgedResults& results, std::span<const Paper> papers) {
  int differing = 0, measured = 0;
  std::vector<Share> shares;
  for (const Paper& paper : papers) {
    const Share share = share_of(results, paper);
    differing += share.differing;
    measured += share.measured;
    if (share.differing > 0) shares.push_back(share);
  }
  if (measured == 0) return "";
  if (differing == 0) return fmt::format("None of {} rows about the papers differs.", measured);
  std::ranges::stable_sort(shares, [](const Share& a, const Share& b) {
    return a.differing * b.measured > b.differing * a.measured;
  });
  std::string text = fmt::format("Of {} rows about the papers, {} differ{} from what was measured", measured,
                                 differing, differing == 1 ? "s" : "");
  for (std::size_t i = 0; i < shares.size(); ++i) {
    text += i == 0                   ? ", the largest share on "
            : i == 1                 ? ", then on "
            : i + 1 == shares.size() ? " and "
                                     : ", ";
    text += fmt::format("“{}” ({} of {})", shares[i].name, shares[i].differing, shares[i].measured);
  }
  return text + ".";
}

Document paper_faults(const JudgedResults& results, std::span<const Paper> papers,
                      const std::string& report) {
  Document document = {Heading{1, std::string(kPaperFaultsTitle), "top"},
                       Paragraph{fmt::format(
                           "Made from the verdicts of profile “{}”. Where text, formula and table of a paper "
                           "disagree, or a sentence can be read in several ways, each reading was built and "
                           "measured. A difference may also be due to other terrain, machines or parameters "
                           "that a paper does not state; the reason says which.",
                           results.profile)}};
  const std::size_t empty = document.size();
  const Page page(results, report);
  for (const Paper& paper : papers) {
    Table differing = page.differing(paper), vague = page.vague(paper);
    if (differing.rows.empty() && vague.rows.empty()) continue;
    document.push_back(Heading{2, paper.title, paper.id});
    for (Table* const table : {&differing, &vague}) {
      if (!table->rows.empty()) document.push_back(TableBlock{std::move(*table), {}});
    }
  }
  return document.size() == empty ? Document() : document;
}

}  // namespace terrabench
