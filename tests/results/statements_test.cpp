#include "results/claims/statements.h"

#include <gtest/gtest.h>

namespace terrabench {
namespace {

struct Row {
  std::string id, of;
  Variation varies;
  Verdict verdict;
  Group group = Group::kStated;
};

class Statements : public testing::Test {
 protected:
  std::vector<Statement> of(const std::vector<Row>& rows) {
    paper_.claims.clear();
    judgements_.clear();
    for (const Row& row : rows) {
      Claim& claim = paper_.claims.emplace_back();
      claim.id = row.id;
      claim.of = row.of;
      claim.varies = row.varies;
      claim.group = row.group;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Judgement& judgement = judgements_.emplace_back();
      judgement.paper = &paper_;
      judgement.claim = &paper_.claims[i];
      judgement.verdict = rows[i].verdict;
    }
    return statements(judgements_);
  }
  Paper paper_;
  std::vector<Judgement> judgements_;
};

TEST_F(Statements, HoldAsPrintedOrInAReadingButNotOnAnotherGround) {
  const auto standing = [&](Verdict claim, Variation varies, Verdict sub_row) {
    return of({{"a", "", Variation::kNone, claim}, {"a.x", "a", varies, sub_row}}).at(0).standing;
  };
  EXPECT_EQ(standing(Verdict::kReproduced, Variation::kReading, Verdict::kDiffers), Standing::kAsPrinted);
  EXPECT_EQ(standing(Verdict::kShape, Variation::kGround, Verdict::kDiffers), Standing::kAsPrinted);
  EXPECT_EQ(standing(Verdict::kDiffers, Variation::kReading, Verdict::kReproduced), Standing::kOtherReading);
  EXPECT_EQ(standing(Verdict::kDiffers, Variation::kReading, Verdict::kDiffers), Standing::kDoesNotHold);
  EXPECT_EQ(standing(Verdict::kDiffers, Variation::kGround, Verdict::kReproduced), Standing::kDoesNotHold);
  EXPECT_EQ(standing(Verdict::kDiffers, Variation::kSetting, Verdict::kReproduced), Standing::kDoesNotHold);
  for (const Verdict none : {Verdict::kNotComparable, Verdict::kNotRun, Verdict::kMissing})
    EXPECT_EQ(standing(none, Variation::kReading, Verdict::kReproduced), Standing::kNotJudged);
}

TEST_F(Statements, NameTheReadingThatHolds) {
  const auto all = of({{"a.1", "a", Variation::kReading, Verdict::kDiffers},
                       {"a", "", Variation::kNone, Verdict::kDiffers},
                       {"a.2", "a", Variation::kReading, Verdict::kShape}});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].sub_rows.size(), 2U);
  ASSERT_NE(all[0].reading, nullptr);
  EXPECT_EQ(all[0].reading->claim->id, "a.2");
}

TEST_F(Statements, AreCountedPerGroupWithoutSubRows) {
  const auto counts =
      count_standings(of({{"a", "", Variation::kNone, Verdict::kReproduced},
                          {"a.1", "a", Variation::kSetting, Verdict::kDiffers},
                          {"b", "", Variation::kNone, Verdict::kDiffers, Group::kBeyond},
                          {"lost", "no-such-claim", Variation::kSetting, Verdict::kDiffers}}));
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts.at(Group::kStated), (StandingCounts{1, 0, 0, 0}));
  EXPECT_EQ(counts.at(Group::kBeyond), (StandingCounts{0, 0, 1, 0}));
  EXPECT_EQ(sum(counts.at(Group::kStated)), 1);
  EXPECT_EQ(counts_text({3, 0, 1, 0}, Group::kStated), "3 hold as printed, 1 does not hold");
  EXPECT_EQ(counts_text({2, 0, 0, 0}, Group::kBeyond), "2 hold");
}

}  // namespace
}  // namespace terrabench
