// Verdicts on whole results folders; judge_test.cpp has those on single claims.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "results/claims/check_output.h"
#include "results/claims/judge.h"
#include "results/store/record_json.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

using JudgeTest = FolderTest;

const Judgement& of(const JudgedResults& results, std::string_view id) {
  const auto it = std::find_if(results.judgements.begin(), results.judgements.end(),
                               [&](const Judgement& j) { return j.claim->id == id; });
  if (it == results.judgements.end()) throw std::runtime_error("no such claim");
  return *it;
}

TEST_F(JudgeTest, WholeRunsPassInBothProfiles) {
  for (const char* profile : {"quick", "paper"}) {
    std::filesystem::remove(file());
    write_fake_results(folder_, profile);
    const JudgedResults results = judge(Store::open(folder_), faked_papers());
    EXPECT_TRUE(results.passed());
    EXPECT_EQ(results.profile, profile);
    EXPECT_EQ(of(results, "hybrid.T1.128").verdict, Verdict::kReproduced);
    EXPECT_EQ(of(results, "hybrid.T2.256").verdict, Verdict::kShape);
    EXPECT_EQ(of(results, "hybrid.F13").verdict, Verdict::kReproduced);
    const Verdict large = profile == std::string("paper") ? Verdict::kReproduced : Verdict::kNotRun;
    EXPECT_EQ(of(results, "hybrid.T1.512").verdict, large);
  }
}

TEST_F(JudgeTest, AFigureAlteredByHandFailsItsClaimEvenInsideTheTolerance) {
  write_fake_results(folder_, "quick");
  edit(file(), "\"stack_heap_bytes\",\"samples\":[213040.0]", "\"stack_heap_bytes\",\"samples\":[213041.0]");
  const JudgedResults results = judge(folder_);
  EXPECT_FALSE(results.passed());
  EXPECT_THAT(of(results, "hybrid.T1.128").check_failure, HasSubstr("altered"));
  EXPECT_EQ(of(results, "hybrid.T1.256").check_failure, "");
}

TEST_F(JudgeTest, PictureAlteredByHandIsAFault) {
  write_fake_results(folder_, "quick");
  // Even one that no claim is about.
  Image image(8, 8, {10, 20, 30});
  write_picture(folder_ / "figures/relief.jacksboro.heightmap.webp", image);
  const JudgedResults results = judge(folder_);
  ASSERT_EQ(results.faults.size(), 1U);
  EXPECT_THAT(results.faults[0], HasSubstr("relief.jacksboro.heightmap.webp: picture altered"));
  EXPECT_FALSE(results.passed());
}

TEST_F(JudgeTest, ClaimsAreChosenByGlob) {
  write_fake_results(folder_, "quick");
  const auto ids = [&](const std::vector<std::string>& globs) {
    std::vector<std::string> found;
    for (const Judgement& j : judge(folder_, globs).judgements) found.push_back(j.claim->id);
    return found;
  };
  EXPECT_THAT(ids({"hybrid.T1.*.128", "hybrid.T2.25?"}),
              testing::ElementsAre("hybrid.T1.voxels.128", "hybrid.T1.ratio.128", "hybrid.T2.256"));
  std::size_t claims = 0;
  for (const Paper& paper : papers()) {
    claims += paper.claims.size() - std::ranges::count_if(paper.claims, &Claim::of_profile_scale);
  }
  EXPECT_EQ(ids({}).size(), claims);
  const std::vector<std::string> wrong = {"hybrid.T1.128", "hybrid.t9*"};
  const Failure failure = failure_of([&] { judge(folder_, wrong); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
  EXPECT_THAT(failure.what, HasSubstr("hybrid.t9*"));
}

TEST_F(JudgeTest, PartialRunFailsForWhatItsProfileShouldHold) {
  write_fake_results(folder_, "quick");
  std::string text = content();
  write_file(file(), text.substr(0, text.find("hybrid.caves")));
  const JudgedResults results = judge(folder_);
  EXPECT_FALSE(results.passed());
  EXPECT_EQ(of(results, "hybrid.caves").verdict, Verdict::kMissing);
  EXPECT_EQ(of(results, "hybrid.T1.128").check_failure, "");
}

// A folder of one experiment, as of a run on a GPU: its claims are judged, the others are not asked for.
TEST_F(JudgeTest, OnlyWhatWasRunIsJudgedWhereAsked) {
  write_fake_results(folder_, "quick");
  std::string kept;
  std::istringstream lines(content());
  for (std::string line; std::getline(lines, line);) {
    const bool other =
        line.find("\"kind\":\"record\"") != line.npos && line.find("hybrid.table1") == line.npos;
    if (!line.empty() && !other) kept += line + "\n";
  }
  write_file(file(), kept);
  const JudgedResults some = judge(folder_, {}, "", Demand::kRun), all = judge(folder_);
  EXPECT_TRUE(some.passed());
  EXPECT_GT(some.judgements.size(), 3U);
  for (const Judgement& judgement : some.judgements)
    EXPECT_EQ(judgement.paper->id, "hybrid") << judgement.claim->id;
  EXPECT_EQ(some.judgements.size() + some.left_out, all.judgements.size() + all.left_out);
  EXPECT_EQ(of(some, "hybrid.T1.128").verdict, Verdict::kReproduced);
  EXPECT_FALSE(all.passed());
  // Growth with size alone, which neither profile measures.
  EXPECT_EQ(all.left_out, std::ranges::count_if(papers().back().claims, &Claim::of_profile_scale));
  EXPECT_THAT(check_text(some, {}), HasSubstr("--all asks for them"));
}

TEST_F(JudgeTest, SaysWhyACaseThatFailedLeavesAClaimWithoutRecords) {
  write_fake_results(folder_, "quick");
  Store store(folder_);
  Record failed = fake_record(fake_provenance(), "hybrid.table1", "n=128");
  failed.outcome = CaseOutcome::kFailed;
  failed.reason = "out of memory";
  store.append(failed);
  const JudgedResults results = judge(store, faked_papers());
  EXPECT_FALSE(results.passed());
  EXPECT_EQ(of(results, "hybrid.T1.128").verdict, Verdict::kMissing);
  EXPECT_THAT(of(results, "hybrid.T1.128").measured, HasSubstr("(failed: out of memory)"));
  ASSERT_EQ(results.absences.size(), 1U);
  EXPECT_THAT(results.absences[0].where, testing::ElementsAre("hybrid.table1 n=128"));
  EXPECT_THAT(check_text(results, {}),
              HasSubstr("Without measurements\nfailed (1 case): out of memory\n  hybrid.table1 n=128\n"));
}

// One line more, of a profile that no claim names, must not turn off every claim.
TEST_F(JudgeTest, ALineOfAnUnknownProfileIsAFault) {
  write_fake_results(folder_, "quick");
  const std::string good = content();
  Record record = fake_record(fake_provenance(), "e", "c");
  record.profile = "nightly";
  write_file(file(), good + to_line(record) + "\n");
  const JudgedResults results = judge(Store::open(folder_), faked_papers());
  EXPECT_EQ(results.profile, "quick");
  EXPECT_EQ(of(results, "hybrid.T1.128").verdict, Verdict::kReproduced);
  EXPECT_FALSE(results.passed());
}

TEST_F(JudgeTest, NothingJudgedIsNoPass) {
  write_fake_results(folder_, "quick");
  const std::vector<std::string> paper_only = {"hybrid.T1.512"};
  const JudgedResults results = judge(folder_, paper_only);
  EXPECT_EQ(results.judgements.at(0).check_failure, "");
  EXPECT_FALSE(results.passed());
  EXPECT_THAT(check_text(results, {}), testing::AllOf(HasSubstr("none of them judged"), HasSubstr("FAIL")));
}

TEST_F(JudgeTest, AQuickRunHidesNoPaperResults) {
  write_fake_results(folder_, "paper");
  write_fake_results(folder_, "quick");
  const JudgedResults newest = judge(folder_);
  EXPECT_EQ(newest.profile, "quick");
  ASSERT_EQ(newest.ignored.size(), 1U);
  EXPECT_THAT(newest.ignored[0], HasSubstr("of profile paper are not read; --profile paper reads them"));
  EXPECT_THAT(check_text(newest, {}), HasSubstr("--profile paper"));
  const JudgedResults chosen = judge(folder_, {}, "paper");
  EXPECT_EQ(chosen.profile, "paper");
  EXPECT_EQ(of(chosen, "hybrid.T1.512").verdict, Verdict::kReproduced);
  std::filesystem::remove(file());
  write_fake_results(folder_, "quick");
  const Failure failure = failure_of([&] { judge(folder_, {}, "paper"); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("no measurements of profile paper"));
}

}  // namespace
}  // namespace terrabench
