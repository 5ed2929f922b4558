#include "results/compare/compare.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "results/store/provenance.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

class CompareTest : public FolderTest {
 protected:
  void write(const std::string& name, const std::vector<Metric>& metrics, std::uint64_t seed = 1,
             const Provenance& run = fake_provenance()) {
    Store store(folder_ / name);
    store.begin_run(run);
    Record record = fake_record(run, "e", "c");
    record.metrics = metrics;
    record.seed = seed;
    store.append(record);
  }
  Change change(const Metric& before, const Metric& after) {
    std::filesystem::remove_all(folder_ / "a");
    std::filesystem::remove_all(folder_ / "b");
    write("a", {before});
    write("b", {after});
    return compare(folder_ / "a", folder_ / "b").metrics.at(0).change;
  }
};

TEST_F(CompareTest, ExactMetricsMustBeEqual) {
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "B", {100}}), Change::kSame);
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "B", {101}}), Change::kDiffers);
  EXPECT_EQ(change({"bytes", "B", {1e9}}, {"bytes", "B", {1e9 + 1}}), Change::kDiffers);
  EXPECT_EQ(change({"cells", "", {100000}}, {"cells", "", {100001}}), Change::kDiffers);
  EXPECT_EQ(change({"bytes", "B", {100}}, {"bytes", "KiB", {100}}), Change::kDiffers);
}

// Six samples.
std::vector<double> around(double middle, double spread) {
  std::vector<double> samples;
  for (const double off : {0.0, 1.0, -1.0, 0.5, -0.5, 0.1}) samples.push_back(middle + off * spread);
  return samples;
}

TEST_F(CompareTest, TimesChangeOnlyBeyondTheirInterval) {
  const Metric base{"t", "s", around(1, 0.05)}, noisy{"t", "s", around(1.02, 0.06)},
      slow{"t", "s", around(2, 0.1)};
  EXPECT_EQ(change(base, noisy), Change::kSame);
  EXPECT_EQ(change(base, slow), Change::kRose);
  EXPECT_EQ(change(slow, base), Change::kFell);
  EXPECT_EQ(change(base, {"t", "s", {7.0}}), Change::kUnresolved);
  EXPECT_EQ(change({"t", "s", std::vector(6, 0.0)}, base), Change::kUnresolved);
  const Metric wide{"t", "s", around(1, 0.4)};
  EXPECT_EQ(change(wide, wide), Change::kUnresolved) << "may have changed by the margin";
  const std::vector before = around(1, 0.01), after = around(3, 0.01);
  EXPECT_EQ(change({"t", "s", before}, {"t", "s", after}), Change::kRose);
  EXPECT_EQ(change({"t", "s", {before.begin(), before.begin() + 5}}, {"t", "s", after}), Change::kUnresolved)
      << "five samples";
}

TEST_F(CompareTest, RatiosOfTimesAreComparedAsTimes) {
  const Metric varying{"share", "", around(0.5, 0.01), true}, plain{"share", "", around(0.5, 0.01)};
  EXPECT_EQ(change(varying, {"share", "", around(0.505, 0.005), true}), Change::kSame);
  EXPECT_EQ(change(varying, {"share", "", around(0.7, 0.01), true}), Change::kRose);
  EXPECT_EQ(change(varying, {"share", "", {0.7}, true}), Change::kUnresolved);
  EXPECT_EQ(change(plain, {"share", "", around(0.505, 0.005), true}), Change::kSame) << "an older run";
  EXPECT_EQ(change(plain, {"share", "", around(0.505, 0.005)}), Change::kDiffers);
}

// An interval of one run does not cover the differences between runs.
TEST_F(CompareTest, ATimeChangesByTheMarginOrMore) {
  const auto by = [](double factor) { return Metric{"t", "s", around(factor, 0.0001 * factor)}; };
  EXPECT_EQ(change(by(1), by(1.24)), Change::kSame);
  EXPECT_EQ(change(by(1), by(1.26)), Change::kRose);
  EXPECT_EQ(change(by(1.24), by(1)), Change::kSame);
  EXPECT_EQ(change(by(1.26), by(1)), Change::kFell);
  write("before", {by(1), {"u", "s", around(1, 0)}, {"bytes", "B", {7}}});
  write("after", {by(1.5), {"u", "s", around(1.1, 0)}, {"bytes", "B", {7}}});
  const Comparison c = compare(folder_ / "before", folder_ / "after");
  EXPECT_NEAR(c.median_ratio, 1.3, 1e-3) << "of the two times";
  EXPECT_THAT(compare_text(c, false), HasSubstr("median ratio × 1.3; a change below × 1.25"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_EQ(json["margin"], 1.25);
  EXPECT_NEAR(json["median_ratio"], 1.3, 1e-3);
}

TEST_F(CompareTest, SaysWhatOnlyOneSideHasAndWhatWasMeasuredOnOtherGround) {
  write("a", {{"m", "B", {1}}, {"gone", "B", {2}}});
  write("b", {{"m", "B", {1}}, {"new", "B", {3}}}, 9);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  ASSERT_EQ(c.metrics.size(), 3U);
  EXPECT_EQ(c.metrics[1].change, Change::kOnlyBefore);
  EXPECT_EQ(c.metrics[2].change, Change::kOnlyAfter);
  EXPECT_FALSE(c.metrics[0].same_ground);
  EXPECT_TRUE(c.exact_equal());
  EXPECT_TRUE(c.passed());
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text, HasSubstr("only before"));
  EXPECT_THAT(text, HasSubstr("seed, terrain or parameters differ"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_THAT(text, HasSubstr("1 same, 1 only before, 1 only after"));
  EXPECT_EQ(json["metrics"].size(), 3U);
  EXPECT_EQ(json["only_before"], 1);
  EXPECT_EQ(json["only_after"], 1);
  EXPECT_EQ(json["metrics"][2]["change"], "only after");
}

// The summary comes first; a line per metric only for what changed, or for all if asked.
TEST_F(CompareTest, ListsWhatChangedAndCountsTheRest) {
  write("a", {{"same", "B", {1}}, {"other", "B", {1}}, {"gone", "B", {2}}, {"lost", "B", {2}}});
  write("b", {{"same", "B", {1}}, {"other", "B", {2}}, {"new", "B", {3}}});
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_EQ(compare_text(c, false),
            "1 same, 1 differs, 2 only before, 1 only after\n"
            "only before: e (quick), cases: 1, metrics: 2\n"
            "only after: e (quick), cases: 1, metrics: 1\n"
            "e c (quick)\n"
            "  * other                      differs      1 B → 2 B  × 2.0000\n");
  const std::string all = compare_text(c, false, true);
  EXPECT_THAT(all, testing::StartsWith("1 same, 1 differs, "));
  for (const MetricChange& m : c.metrics) EXPECT_THAT(all, HasSubstr(m.metric));
}

// Such as the reference, of profile paper, against a quick run.
TEST_F(CompareTest, NothingInCommonIsBadInput) {
  write_fake_results(folder_ / "a", "quick");
  write_fake_results(folder_ / "b", "paper");
  const Failure failure = failure_of([&] { compare(folder_ / "a", folder_ / "b"); });
  EXPECT_EQ(failure.code, ExitCode::kBadInput);
  EXPECT_THAT(failure.what, HasSubstr("nothing in common: quick against paper"));
  write("c", {{"m", "B", {1}}});
  write("d", {{"n", "B", {1}}});
  EXPECT_THAT(failure_of([&] { compare(folder_ / "c", folder_ / "d"); }).what,
              HasSubstr("nothing in common: both hold profile quick, but other cases"));
}

TEST_F(CompareTest, RatioToZeroIsStillJson) {
  write("a", {{"m", "", {0}}, {"t", "s", {0, 0}}});
  write("b", {{"m", "", {1}}, {"t", "s", {1, 1}}});
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  EXPECT_FALSE(c.exact_equal());
  EXPECT_TRUE(nlohmann::json::accept(compare_json(c)));
}

// Times of two machines say nothing about the code; exact figures must be the same on both.
TEST_F(CompareTest, ComparesExactFiguresAcrossMachinesAndTimesWithinOne) {
  const Metric fast{"t", "s", around(1, 0.1)}, slow{"t", "s", around(2, 0.1)};
  Provenance other = fake_provenance();
  other.cpu = "Another processor";
  other.id = digest(other);
  write("a", {{"bytes", "B", {100}}, {"error", "m", {0.5}}, fast});
  write("b", {{"bytes", "B", {100}}, {"error", "m", {0.75}}, slow}, 1, other);
  const Comparison c = compare(folder_ / "a", folder_ / "b");
  ASSERT_EQ(c.metrics.size(), 3U);
  EXPECT_EQ(c.metrics[0].change, Change::kSame);
  EXPECT_EQ(c.metrics[1].change, Change::kDiffers);
  EXPECT_EQ(c.metrics[2].change, Change::kElsewhere);
  EXPECT_FALSE(c.passed());
  const std::string text = compare_text(c, false);
  EXPECT_THAT(text, HasSubstr("differs between machines: e c error: 0.5 m on A processor <of & for> tests, 2 "
                              "threads, AVX2, llvmpipe; 0.75 m on Another processor, 2 threads"));
  EXPECT_THAT(text, HasSubstr("1 exact figures differ between machines"));
  const auto json = nlohmann::json::parse(compare_json(c));
  EXPECT_EQ(json["metrics"][1]["machines"][1], machine_name(other));
  EXPECT_EQ(json["metrics"][2]["change"], "elsewhere");
}

TEST_F(CompareTest, OtherCodeOnTheSameMachineIsCompared) {
  Provenance other = fake_provenance();
  other.git_revision = "fedcba";
  other.compiler = "Clang 15";
  other.id = digest(other);
  write("a", {{"t", "s", around(1, 0.1)}});
  write("b", {{"t", "s", around(2, 0.1)}}, 1, other);
  EXPECT_EQ(compare(folder_ / "a", folder_ / "b").metrics.at(0).change, Change::kRose);
  other.threads = 1;
  other.id = digest(other);
  write("c", {{"t", "s", around(2, 0.1)}}, 1, other);
  EXPECT_EQ(compare(folder_ / "a", folder_ / "c").metrics.at(0).change, Change::kElsewhere);
}

TEST_F(CompareTest, FaultsOfEitherSideAreSaidAndFail) {
  write("a", {{"m", "B", {1}}});
  write("b", {{"m", "B", {1}}});
  EXPECT_TRUE(compare(folder_ / "a", folder_ / "b").passed());
  edit(folder_ / "b/measurements.jsonl", "\"seed\":1", "\"seed\":2");
  for (const auto& [before, after] : {std::pair("a", "b"), std::pair("b", "a")}) {
    const Comparison c = compare(folder_ / before, folder_ / after);
    EXPECT_EQ(c.faults.size(), 1U);
    EXPECT_TRUE(c.exact_equal());
    EXPECT_FALSE(c.passed());
    EXPECT_THAT(compare_text(c, false), HasSubstr("altered"));
    EXPECT_EQ(nlohmann::json::parse(compare_json(c))["passed"], false);
  }
}

}  // namespace
}  // namespace terrabench
