#include "results/report/advice.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace terrabench {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class AdviceTest : public testing::Test {
 protected:
  AdviceTest() { layout_.question = "Fewest triangles"; }

  // A ranking of exact values, the best first; the first `tied` are tied.
  Ranking ranking(const std::vector<std::pair<std::string, double>>& places, std::size_t tied = 1) const {
    Ranking ranking;
    ranking.layout = &layout_;
    ranking.tied = tied;
    for (const auto& [label, value] : places) {
      const double factor = value / places[0].second;
      ranking.places.push_back({label, value, {1, factor, factor, factor}});
    }
    return ranking;
  }
  std::vector<std::string> row(const Ranking& here) const {
    std::vector<std::string> texts;
    const Table table = advice(std::span(&here, 1), elsewhere_);
    for (const Cell& cell : table.rows[0]) texts.push_back(cell.text);
    return texts;
  }

  RankingLayout layout_;
  std::vector<Answer> elsewhere_;
};

TEST_F(AdviceTest, HasTheBestTheNextAndTheReason) {
  EXPECT_THAT(row(ranking({{"ROAM", 143}, {"MRBSP", 286}, {"clipmap", 900}})),
              ElementsAre("Fewest triangles", "ROAM", "MRBSP", "2 ×", "–", "143 against 286 (MRBSP)"));
  EXPECT_THAT(row(ranking({{"ROAM", 143}, {"MRBSP", 143}, {"clipmap", 900}}, 2)),
              ElementsAre("Fewest triangles", "MRBSP ≈ ROAM", "clipmap", "tied", "–", "ROAM 143, MRBSP 143"));
  EXPECT_THAT(row(ranking({{"ROAM", 143}})),
              ElementsAre("Fewest triangles", "ROAM", "–", "alone", "–", "143; no other method has a value"));
  EXPECT_THAT(row(ranking({})), ElementsAre("Fewest triangles", "not decided", "–", "–", "–",
                                            "no method comes within that error"));
}

TEST_F(AdviceTest, SaysWhyNothingIsDecided) {
  Ranking close = ranking({{"ROAM", 1}, {"MRBSP", 1.1}, {"clipmap", 9}}, 2);
  close.undecided = true;
  EXPECT_THAT(row(close)[1], "not decided");
  EXPECT_THAT(row(close)[5], "the samples vary too much to tell apart ROAM 1, MRBSP 1.1");
  close.too_few = true;
  EXPECT_THAT(row(close)[5], "measured fewer than 6 times: ROAM 1, MRBSP 1.1");
}

TEST_F(AdviceTest, WritesRatesInWords) {
  layout_.unit = "1/s";
  EXPECT_EQ(row(ranking({{"stack", 12.4e6}, {"voxels", 830e3}}))[5],
            "12.4 million per second against 830,000 per second (voxels)");
}

TEST_F(AdviceTest, ComparesWithTheGroundsThatHaveTheQuestion) {
  RankingLayout other = layout_, solid = layout_;
  other.question = "Smallest file";
  solid.kind = "solid";
  elsewhere_ = {{&layout_, {"ROAM"}},    {&layout_, {"MRBSP", "ROAM"}},
                {&layout_, {"clipmap"}}, {&layout_, {}},
                {&other, {"TIN"}},       {&solid, {"TIN"}}};
  EXPECT_EQ(row(ranking({{"ROAM", 1}, {"MRBSP", 2}}))[4], "as on 2 of 4");
  EXPECT_EQ(row(ranking({{"clipmap", 1}, {"MRBSP", 2}}))[4], "differs: ROAM on 2 of 4");
  EXPECT_EQ(row(ranking({}))[4], "ROAM on 2 of 4");
  elsewhere_ = {{&layout_, {}}};
  EXPECT_EQ(row(ranking({{"ROAM", 1}}))[4], "not decided there");
}

TEST_F(AdviceTest, IsATableAndReasonsOnATerminal) {
  const Ranking here = ranking({{"ROAM", 143}, {"MRBSP", 286}});
  EXPECT_EQ(advice_text(advice(std::span(&here, 1), elsewhere_)),
            "Question          Take  Next   Lead  Reference\n"
            "Fewest triangles  ROAM  MRBSP  2 ×   –\n"
            "\nWhy:\n"
            "  Fewest triangles: 143 against 286 (MRBSP)\n");
}

// The committed report has the answers of every ground with a page, to the questions that the claims files
// ask.
TEST(ReferenceAnswers, AreInsideTheProgram) {
  std::set<std::string> questions, answered, grounds;
  for (const RankingLayout& layout : ranking_layouts()) {
    if (!layout.ground.empty()) questions.insert(layout.question);
  }
  for (const Answer& answer : reference_answers()) {
    answered.insert(answer.layout->question);
    grounds.insert(answer.layout->ground);
  }
  EXPECT_THAT(answered, IsSupersetOf(questions));
  EXPECT_THAT(grounds, IsSupersetOf({"jacksboro", "helens", "maine", "fractal", "caves"}));
}

TEST(Purposes, ChooseQuestionsAndTheirExperiments) {
  EXPECT_THAT(purposes(), testing::UnorderedElementsAre("flying", "walking", "editing", "archiving"));
  for (const std::string& purpose : purposes())
    EXPECT_THAT(experiments_for(purpose), Not(testing::IsEmpty()));
  EXPECT_THAT(experiments_for("flying"), Contains("cross.lod-equal-error"));
  EXPECT_THAT(experiments_for("archiving"), Not(Contains(HasSubstr("lod"))));
  EXPECT_THAT(experiments_for(""),
              IsSupersetOf({"cross.representations", "cross.file-size", "cross.lod-edit"}));
}

}  // namespace
}  // namespace terrabench
