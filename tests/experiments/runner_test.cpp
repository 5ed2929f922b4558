#include "experiments/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> names(const RunPlan& plan) {
  std::vector<std::string> out;
  for (const PlannedCase& planned : plan_cases(plan)) {
    out.push_back(std::string(planned.experiment->id) + " " + planned.at.name);
  }
  return out;
}

TEST(Plan, ExperimentIdsAndCasesAreUnique) {
  for (const Profile profile : {Profile::kQuick, Profile::kPaper, Profile::kScale}) {
    RunPlan plan;
    plan.options.profile = profile;
    const auto all = names(plan);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
    EXPECT_FALSE(all.empty());
  }
}

TEST(Plan, PaperProfileHasThePrintedSizes) {
  RunPlan plan;
  plan.options.profile = Profile::kPaper;
  plan.patterns = {"hybrid.table1"};
  EXPECT_EQ(names(plan),
            (std::vector<std::string>{"hybrid.table1 n=128", "hybrid.table1 n=256", "hybrid.table1 n=512"}));
}

TEST(Plan, GrowthWithSizeIsMeasuredInAProfileOfItsOwn) {
  RunPlan plan;
  plan.patterns = {"cross.*"};
  for (const Profile profile : {Profile::kQuick, Profile::kPaper}) {
    plan.options.profile = profile;
    for (const std::string& name : names(plan)) EXPECT_FALSE(name.starts_with("cross.scale ")) << name;
  }
  plan.options.profile = Profile::kScale;
  EXPECT_FALSE(names(plan).empty());
  for (const std::string& name : names(plan)) EXPECT_TRUE(name.starts_with("cross.scale ")) << name;
  plan.patterns = {"hybrid.table1"};
  EXPECT_THROW(plan_cases(plan), Error);
  plan.options.profile = Profile::kQuick;
  plan.patterns = {"cross.scale"};
  EXPECT_THROW(plan_cases(plan), Error);
}

TEST(Plan, WordsThatMatchNoExperimentChooseAmongTheCasesOfTheOthers) {
  RunPlan plan;
  plan.options.profile = Profile::kPaper;
  plan.patterns = {"hybrid.table*", "n=128", "n=5*"};
  const std::vector<std::string> chosen = names(plan);
  EXPECT_THAT(chosen, ::testing::IsSupersetOf({"hybrid.table1 n=128", "hybrid.table1 n=512"}));
  EXPECT_THAT(chosen, ::testing::Not(::testing::Contains("hybrid.table1 n=256")));
  plan.patterns = {"n=128"};  // of which experiment?
  EXPECT_THROW(plan_cases(plan), Error);
}

TEST(Plan, AMistypedCaseHasASuggestion) {
  RunPlan plan;
  plan.options.profile = Profile::kPaper;
  plan.patterns = {"hybrid.table1", "n=1288"};
  const Failure failure = failure_of([&] { plan_cases(plan); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
  EXPECT_THAT(failure.what, HasSubstr("did you mean 'n=128'"));
  EXPECT_THAT(failure.advice, HasSubstr("--dry-run"));
  plan.patterns = {"hybrid.table1", "hybrid.tabel2"};
  EXPECT_THAT(failure_of([&] { plan_cases(plan); }).what, HasSubstr("did you mean 'hybrid.table2'"));
}

TEST(Plan, ShardsPartitionTheCases) {
  RunPlan plan;
  const auto all = names(plan);
  std::vector<std::string> together;
  plan.shards = 3;
  for (plan.shard = 1; plan.shard <= 3; ++plan.shard) {
    const auto part = names(plan);
    EXPECT_LT(part.size(), all.size());
    together.insert(together.end(), part.begin(), part.end());
  }
  EXPECT_THAT(together, ::testing::UnorderedElementsAreArray(all));
}

TEST(Plan, AssignmentsReachEveryCaseThatHasTheParameterAndRenameIt) {
  RunPlan plan;
  plan.patterns = {"hybrid.table2"};
  plan.assignments = {"n=16"};
  for (const PlannedCase& planned : plan_cases(plan)) {
    EXPECT_EQ(planned.at.parameters.integer("n"), 16);
    EXPECT_THAT(planned.at.name, HasSubstr("(n=16)"));
  }
}

TEST(Plan, UnknownNamesSuggestTheNearest) {
  RunPlan plan;
  plan.patterns = {"hybrid.tabel1"};
  const Failure failure = failure_of([&] { plan_cases(plan); });
  EXPECT_EQ(failure.code, ExitCode::kUsage);
  EXPECT_THAT(failure.what, HasSubstr("did you mean 'hybrid.table1'"));
  plan.patterns = {"hybrid.table1"};
  plan.assignments = {"m=3"};
  EXPECT_THROW(plan_cases(plan), Error);
  plan.assignments = {"n=0"};
  EXPECT_THROW(plan_cases(plan), Error);
  plan.assignments = {"n=many"};
  EXPECT_THROW(plan_cases(plan), Error);
}

}  // namespace
}  // namespace terrabench
