#include "experiments/time_left.h"

#include <gmock/gmock.h>

#include "experiments/runner.h"

namespace terrabench::test {
namespace {

using testing::HasSubstr;

TEST(TimeLeft, ForecastsWhatIsKnownAndSaysWhatIsNot) {
  TimeLeft time;
  time.expect(0);
  EXPECT_EQ(time.forecast(), "");
  time.expect(100);
  time.expect(200);
  EXPECT_EQ(time.forecast(),
            "this takes about 5 min on two cores, and the 1 case that the reference run did not time\n");
}

TEST(TimeLeft, SaysNothingOfTheFirstSeconds) {
  TimeLeft time;
  time.expect(100);
  EXPECT_EQ(time.text(50), "");
}

TEST(ExpectedSeconds, AreThoseOfTheReferenceRunSharedAmongJobs) {
  RunPlan plan;
  plan.patterns = {"overview.relief", "jacksboro/*"};  // timed
  const std::vector<PlannedCase> timed = plan_cases(plan);
  plan.patterns = {"hybrid.landscape"};  // untimed
  const std::vector<PlannedCase> untimed = plan_cases(plan);
  ASSERT_FALSE(timed.empty());
  ASSERT_FALSE(untimed.empty());
  const double alone = expected_seconds(plan, untimed[0]), by_itself = expected_seconds(plan, timed[0]);
  EXPECT_GT(alone, 0);
  EXPECT_GT(by_itself, 0);
  plan.jobs = 2;
  EXPECT_EQ(expected_seconds(plan, untimed[0]), alone / 2);
  EXPECT_EQ(expected_seconds(plan, timed[0]), by_itself);
  plan.seconds = [](const PlannedCase&) { return 3.0; };
  EXPECT_EQ(expected_seconds(plan, timed[0]), 3);
  plan.patterns = {"overview.relief"};
  plan.options.terrains = {"maine"};
  plan.seconds = {};
  EXPECT_EQ(expected_seconds(plan, plan_cases(plan)[0]), 0);  // not in the reference run
}

}  // namespace
}  // namespace terrabench::test
