// One case that fails or cannot be measured does not end a run.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "results/store/store.h"
#include "terrain/files.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FailedCases : public CommandLine {
 protected:
  // An Arc/Info ASCII grid with cells of 10 m; height −9999 is void.
  void write_grid(const std::string& name, int width, int depth, double (*height)(int, int)) const {
    std::string text = "ncols " + std::to_string(width) + "\nnrows " + std::to_string(depth) +
                       "\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n";
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) text += std::to_string(height(i, j)) + " ";
      text += "\n";
    }
    write_file(folder_ / name, std::string_view(text));
  }
  Store results() const { return Store::open(folder_ / "out"); }
  const Record& record(const Store& store, const std::string& experiment,
                       const std::string& case_name) const {
    const Record* const found = store.find(experiment, case_name, "quick");
    if (found == nullptr) throw std::runtime_error(experiment + " " + case_name + " has no record");
    return *found;
  }
};

TEST_F(FailedCases, RatiosToAReliefOfZeroAreNotDefined) {
  write_grid("flat.asc", 12, 12, [](int, int) { return 5.0; });
  const Outcome run = call("$T run cross.representations --terrain flat.asc --set rays=64 --out out");
  EXPECT_EQ(run.code, 0) << run.text;
  const Store store = results();
  const Record& asked = record(store, "cross.representations", "flat.asc/heightmap/rmse=2% (rays=64)");
  EXPECT_EQ(asked.find("of_asked"), nullptr);
  EXPECT_THAT(std::string(asked.why_absent("of_asked").value().reason), HasSubstr("flat"));
  const Record& built = record(store, "cross.representations", "flat.asc/heightmap (rays=64)");
  EXPECT_EQ(built.find("rmse")->samples[0], 0);
  EXPECT_EQ(built.find("dig_time"), nullptr);
  EXPECT_THAT(std::string(built.why_absent("dig_time").value().reason), HasSubstr("too flat"));
  EXPECT_THAT(call("$T check out --verbose").text, HasSubstr("not defined ("));
  ASSERT_EQ(call("$T report out").code, 0);
  EXPECT_THAT(read_file(folder_ / "out/report/runs.md"),
              AllOf(HasSubstr("Without measurements"), HasSubstr("not defined")));
}

TEST_F(FailedCases, ATypeThatCannotHoldTheGroundIsSkipped) {
  write_grid("small.asc", 3, 2, [](int i, int j) { return 2.0 * i + j; });
  const std::string command = "$T run cross.representations --terrain small.asc --set rays=64 --out out";
  const Outcome run = call(command);
  EXPECT_EQ(run.code, 0) << run.text;
  const Store store = results();
  const Record& drill = record(store, "cross.representations", "small.asc/drill (rays=64)");
  EXPECT_EQ(drill.outcome, CaseOutcome::kSkipped);
  EXPECT_FALSE(drill.reason.empty());
  EXPECT_EQ(drill.terrain, "small.asc");
  EXPECT_NE(record(store, "cross.representations", "small.asc/heightmap (rays=64)").find("rmse"), nullptr);
  EXPECT_THAT(run.text, AllOf(HasSubstr("skipped ("), HasSubstr("cross.representations small.asc/drill")));
  const Outcome again = call(command + " --resume");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.text, AllOf(HasSubstr(" cases were already in the results folder"),
                                HasSubstr("skipped ("), Not(HasSubstr("[1/"))));
}

TEST_F(FailedCases, AReliefOfATypeThatCannotHoldTheGroundIsSkipped) {
  write_grid("small.asc", 3, 2, [](int i, int j) { return 2.0 * i + j; });
  const Outcome run = call("$T run overview.relief --terrain small.asc --set width=64,height=64 --out out");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_THAT(run.text, AllOf(HasSubstr("skipped ("), HasSubstr("overview.relief small.asc/drill")));
}

TEST_F(FailedCases, AFailedCaseIsRecordedListedAndMeasuredAgain) {
  const std::string command =
      "$T run hybrid.fresnel cross.lod-seams --terrain jacksboro --set path=missing.toml --out out";
  const Outcome run = call(command);
  EXPECT_EQ(run.code, 5) << run.text;
  const Store store = results();
  std::size_t failed = 0, measured = 0;
  for (const Record& r : store.records()) (r.outcome == CaseOutcome::kFailed ? failed : measured) += 1;
  EXPECT_GT(failed, 1U);
  EXPECT_GT(measured, 0U);
  EXPECT_THAT(run.text,
              AllOf(HasSubstr("failed (" + std::to_string(failed) + " cases): "), HasSubstr("missing.toml")));
  const Outcome again = call(command + " --resume");
  EXPECT_EQ(again.code, 5);
  EXPECT_THAT(again.text, HasSubstr("\n" + std::to_string(measured) + " of "));
  EXPECT_EQ(call("$T check out").code, 1);
  EXPECT_THAT(call("$T check out").text, HasSubstr("failed ("));
}

TEST_F(FailedCases, NamesThatNoRecordCanHoldAreRefusedBeforeMeasuring) {
  write_grid("a\tb.asc", 3, 3, [](int i, int) { return 1.0 * i; });
  const Outcome tab = call("$T run cross.representations --terrain \"$(printf 'a\\tb.asc')\" --out out");
  EXPECT_EQ(tab.code, 2) << tab.text;
  EXPECT_THAT(tab.text, HasSubstr("holds control characters"));
  const std::string deep(90, 'x');
  std::filesystem::create_directories(folder_ / deep / deep);
  write_grid(deep + "/" + deep + "/a.asc", 3, 3, [](int i, int) { return 1.0 * i; });
  const Outcome long_path =
      call("$T run cross.representations --terrain " + deep + "/" + deep + "/a.asc --out out");
  EXPECT_EQ(long_path.code, 2) << long_path.text;
  EXPECT_THAT(long_path.text, HasSubstr("at most 200 are allowed"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace terrabench
