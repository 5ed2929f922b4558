// Which cases may run beside each other, and that they then record the same.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <set>
#include <thread>
#include <utility>

#include "experiments/runner.h"
#include "results/store/statistics.h"
#include "results/store/store.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kRun =
    "$T run hybrid.noise-stages hybrid.fresnel hybrid.table2 --set n=16,pixels=16 --threads 2 ";

TEST(Timing, UntimedCasesRecordedNoTimeInTheReference) {
  RunPlan plan;
  plan.options.profile = Profile::kPaper;
  std::set<std::pair<std::string, std::string>> untimed_cases;
  plan.part = Part::kUntimed;
  for (const PlannedCase& planned : plan_cases(plan)) {
    untimed_cases.emplace(planned.experiment->id, planned.at.name);
  }
  const Store reference = Store::open(TERRABENCH_SOURCE_DIR "/results/reference");
  std::size_t timed = 0, untimed = 0;
  for (const Record& record : reference.records()) {
    if (experiment(record.experiment).kind != Experiment::kUntimed &&
        !untimed_cases.contains({record.experiment, record.case_name})) {
      ++timed;
      continue;
    }
    ++untimed;
    for (const Metric& metric : record.metrics) {
      EXPECT_FALSE(is_timing(metric.unit)) << record.experiment << " " << metric.name;
    }
  }
  EXPECT_GT(timed, 100U);
  EXPECT_GT(untimed, 100U);
}

TEST(Timing, PartsOfAPlanAreTheWholeAndShardsCountWithinAPart) {
  RunPlan plan;
  const std::size_t all = plan_cases(plan).size();
  plan.part = Part::kTimed;
  const std::size_t timed = plan_cases(plan).size();
  for (const PlannedCase& planned : plan_cases(plan)) {
    EXPECT_TRUE(planned.experiment->timed(planned.at));
  }
  plan.part = Part::kUntimed;
  const std::size_t untimed = plan_cases(plan).size();
  for (const PlannedCase& planned : plan_cases(plan)) {
    EXPECT_FALSE(planned.experiment->timed(planned.at));
  }
  EXPECT_EQ(timed + untimed, all);
  EXPECT_GT(timed, 0U);
  plan.shards = 2;
  EXPECT_EQ(plan_cases(plan).size(), (untimed + 1) / 2);
}

TEST_F(CommandLine, JobsRecordTheSameInOneRun) {
  ASSERT_EQ(call(std::string(kRun) + "--out alone").code, 0);
  const Outcome beside = call(std::string(kRun) + "--out beside --jobs 3");
  ASSERT_EQ(beside.code, 0) << beside.text;
  EXPECT_EQ(call("$T compare alone beside").code, 0);
  const Store alone = Store::open(folder_ / "alone"), store = Store::open(folder_ / "beside");
  ASSERT_EQ(store.records().size(), alone.records().size());
  for (const Record& record : store.records()) {
    EXPECT_EQ(record.run, store.records().front().run);
    for (const RecordedFigure& figure : record.figures) EXPECT_TRUE(store.intact(figure)) << figure.file;
  }
  // The timed ones come last, since they wait until they are alone.
  EXPECT_EQ(store.records().back().experiment, "hybrid.table2");
  EXPECT_THAT(call(std::string(kRun) + "--out beside --jobs 2 --resume").text,
              HasSubstr("cases were already in the results folder"));
}

// The first process that the run starts is not the case's: it finds out the provenance. It has ended when
// there are results.
TEST_F(CommandLine, ACaseOfScaleIsMeasuredInAProcessOfItsOwn) {
  const Outcome killed = call(
      "$T run --profile scale --shard 1/20 --set largest=4097,seconds=1000 --out out & run=$!\n"
      "for try in $(seq 3000); do [ -s out/measurements.jsonl ] && break; sleep 0.01; done\n"
      "for try in $(seq 300); do\n"
      "  kill -KILL $(grep -ls \"^PPid:.$run\\$\" /proc/[0-9]*/status | cut -d/ -f3) && break; sleep 0.01\n"
      "done; wait $run");
  EXPECT_EQ(killed.code, 5) << killed.text;
  EXPECT_THAT(killed.text, AllOf(HasSubstr("cross.scale heights/heightmap"),
                                 HasSubstr("failed: the process was ended by signal 9 (Killed)")));
  const Store store = Store::open(folder_ / "out");
  EXPECT_EQ(store.records().at(0).outcome, CaseOutcome::kFailed);
}

// A terminal sends it to the whole group: to the run and to the process of the case.
TEST_F(CommandLine, CtrlCDuringACaseOfScaleLeavesNoTemporaryFiles) {
  const auto entries = [&] {
    return std::distance(std::filesystem::directory_iterator(folder_ / "tmp"), {});
  };
  std::filesystem::create_directory(folder_ / "tmp");
  const pid_t child = start(
      "TMPDIR=$PWD/tmp exec $T run --profile scale --shard 1/20 --set largest=4097,seconds=1000 --out out");
  for (int i = 0; i < 600 && entries() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GT(entries(), 0);
  kill(-child, SIGINT);
  const Outcome outcome = wait(child);
  EXPECT_EQ(outcome.code, 130) << outcome.text;
  EXPECT_EQ(entries(), 0);
}

TEST_F(CommandLine, AFolderThatCannotBeWrittenEndsTheRun) {
  ASSERT_EQ(call("mkdir -p out && touch out/figures").code, 0);
  const Outcome failed = call(std::string(kRun) + "--out out --jobs 2");
  EXPECT_EQ(failed.code, 4) << failed.text;
  EXPECT_THAT(failed.text, HasSubstr("out/figures"));
}

}  // namespace
}  // namespace terrabench
