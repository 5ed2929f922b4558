#include "results/paper_faults.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace terrabench {
namespace {

using Rows = std::vector<std::pair<About, Verdict>>;

// One paper per title, with a row per verdict.
std::string sentence_of(const std::vector<std::pair<std::string, Rows>>& contents) {
  std::vector<Paper> papers;
  for (const auto& [title, rows] : contents) {
    Paper& paper = papers.emplace_back();
    paper.title = title;
    for (const auto& [about, verdict] : rows) {
      Claim& claim = paper.claims.emplace_back();
      claim.about = about;
    }
  }
  JudgedResults results;
  for (std::size_t p = 0; p < papers.size(); ++p) {
    for (std::size_t c = 0; c < papers[p].claims.size(); ++c) {
      Judgement judgement;
      judgement.paper = &papers[p];
      judgement.claim = &papers[p].claims[c];
      judgement.verdict = contents[p].second[c].second;
      results.judgements.push_back(judgement);
    }
  }
  return where_papers_differ(results, papers);
}

constexpr std::pair kSame{About::kPaper, Verdict::kReproduced}, kDiffers{About::kPaper, Verdict::kDiffers},
    kShape{About::kPaper, Verdict::kShape}, kNotRun{About::kPaper, Verdict::kNotRun},
    kRepeat{About::kRepeat, Verdict::kDiffers}, kOurs{About::kOurs, Verdict::kDiffers};

TEST(WherePapersDiffer, NamesTheLargestShareFirst) {
  EXPECT_EQ(
      sentence_of({{"Clouds: fast and slow", {kSame, kShape, kDiffers}},
                   {"Rivers", {kDiffers, kSame}},
                   {"Dunes", {kDiffers}},
                   {"Reefs", {kSame}}}),
      "Of 7 rows about the papers, 3 differ from what was measured, the largest share on “Dunes” (1 of 1), "
      "then on “Rivers” (1 of 2) and “Clouds” (1 of 3).");
}

TEST(WherePapersDiffer, CountsMeasuredRowsAboutPapersAlone) {
  EXPECT_EQ(sentence_of({{"Rivers", {kSame, kDiffers, kNotRun, kRepeat, kOurs}}, {"Across", {kOurs}}}),
            "Of 2 rows about the papers, 1 differs from what was measured, the largest share on “Rivers” (1 "
            "of 2).");
  EXPECT_EQ(sentence_of({{"Rivers", {kSame, kShape}}}), "None of 2 rows about the papers differs.");
  EXPECT_EQ(sentence_of({{"Across", {kOurs}}}), "");
}

}  // namespace
}  // namespace terrabench
