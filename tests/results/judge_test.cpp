#include "results/claims/judge.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "results/store/record_json.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

// One claim with these conditions, measured against one record with these metrics.
class OneClaim : public FolderTest {
 protected:
  Judgement judge_one(const std::string& check, const std::string& type = "E", const std::string& more = "") {
    std::filesystem::remove(file());
    Store store(folder_);
    const Provenance run = fake_provenance();
    store.begin_run(run);
    Record record = fake_record(run, "e", "c");
    record.metrics = metrics_;
    record.figures = figures_;
    store.append(record);
    for (const auto& [other, metrics] : other_runs_) {
      store.begin_run(other);
      Record more = fake_record(other, "e", "d");
      more.metrics = metrics;
      store.append(more);
    }
    papers_ = {paper_with_claim(type, check, more)};
    return judge(store, papers_).judgements.at(0);
  }
  Verdict verdict(const std::string& check, const std::string& type = "E") {
    return judge_one(check, type).verdict;
  }

  std::vector<Metric> metrics_;
  std::vector<RecordedFigure> figures_;
  std::vector<std::pair<Provenance, std::vector<Metric>>> other_runs_;  // each measured e/d
  std::vector<Paper> papers_;
};

TEST_F(OneClaim, EqualIsExact) {
  metrics_ = {{"m", "B", {393216}}, {"n", "B", {393216}}};
  EXPECT_EQ(verdict("{equal = [\"e/c/m\", 393216]}"), Verdict::kReproduced);
  EXPECT_EQ(verdict("{equal = [\"e/c/m\", \"e/c/n\", 393216]}"), Verdict::kReproduced);
  EXPECT_EQ(verdict("{equal = [\"e/c/m\", 393217]}"), Verdict::kDiffers);
}

TEST_F(OneClaim, OrderIsStrict) {
  metrics_ = {{"m", "", {2}}, {"n", "", {3}}};
  EXPECT_EQ(verdict("{order = [1, \"e/c/m\", \"e/c/n\", 4]}"), Verdict::kReproduced);
  EXPECT_EQ(verdict("{order = [2, \"e/c/m\"]}"), Verdict::kDiffers);
  EXPECT_EQ(verdict("{order = [\"e/c/n\", \"e/c/m\"]}"), Verdict::kDiffers);
}

// As in rankings: what the interval does not show is no order.
TEST_F(OneClaim, TheOrderOfTimesHoldsBeyondTheMarginAlone) {
  const auto of = [&](std::vector<double> samples) {
    metrics_ = {{"m", "s", {1, 1, 1, 1, 1, 1}}, {"n", "s", std::move(samples)}};
    const Judgement found = judge_one("{order = [\"e/c/m\", \"e/c/n\"]}");
    return std::string(name(found.verdict)) + ": " + found.measured;
  };
  EXPECT_EQ(of({2, 2, 2, 2, 2, 2}), "reproduced: m 1 s < n 2 s");
  EXPECT_EQ(of({1.2, 1.2, 1.2, 1.2, 1.2, 1.2}), "differs: m 1 s < n 1.2 s (a tie: × 1.2 [1.2, 1.2])");
  EXPECT_THAT(of({1, 1, 2, 2, 3, 3}), HasSubstr("differs: m 1 s < n 2 s (undecided: × 2 ["));
  EXPECT_EQ(of({2, 2, 2, 2, 2}), "differs: m 1 s < n 2 s (sampled fewer than 6 times)");
  EXPECT_EQ(of({0.5, 0.5, 0.5, 0.5, 0.5, 0.5}), "differs: m 1 s ≥ n 0.5 s (100 % above)");
}

TEST_F(OneClaim, ShapeClaimsSayShape) {
  metrics_ = {{"m", "s", {1}}, {"n", "s", {8}}};
  EXPECT_EQ(verdict("{growth = [\"e/c/m\", \"e/c/n\"], range = [6.5, 9.5]}", "S"), Verdict::kShape);
  EXPECT_EQ(verdict("{ratio = [\"e/c/m\", \"e/c/n\"], range = [0.1, 0.2]}", "S"), Verdict::kShape);
  EXPECT_EQ(verdict("{growth = [\"e/c/n\", \"e/c/m\"], range = [6.5, 9.5]}", "S"), Verdict::kDiffers);
}

TEST_F(OneClaim, MedianDecidesAndItsSpreadIsSaid) {
  metrics_ = {{"steady", "s", {0.96, 0.97, 0.98, 0.97, 0.96}},
              {"spread", "s", {0.90, 0.96, 0.97, 0.98, 1.02, 1.01}},
              {"barely", "s", {0.90, 0.96, 1.01, 1.02, 1.03, 0.97, 1.04}},
              {"inside", "s", {1.2, 1.21, 1.22, 1.2, 1.21}},
              {"wild", "s", {0.1, 0.2, 1.1, 5, 9, 1.2, 0.3}}};
  const auto judged = [&](const std::string& metric) {
    const Judgement found = judge_one("{within = [\"e/c/" + metric + "\"], range = [1, 1.5]}", "T");
    return std::pair(found.verdict, found.measured);
  };
  EXPECT_THAT(judged("steady"), Pair(Verdict::kDiffers, AllOf(HasSubstr("not in [1, 1.5] but 3 % below"),
                                                              Not(HasSubstr("uncertain")))));
  EXPECT_THAT(judged("spread"),
              Pair(Verdict::kDiffers, HasSubstr("uncertain: the 95 % interval reaches in")));
  EXPECT_THAT(judged("barely"),
              Pair(Verdict::kReproduced, HasSubstr("uncertain: the 95 % interval reaches outside")));
  EXPECT_THAT(judged("wild"),
              Pair(Verdict::kReproduced, HasSubstr("uncertain: the 95 % interval reaches outside")));
  EXPECT_THAT(judged("inside"), Pair(Verdict::kReproduced, Not(HasSubstr("uncertain"))));
}

TEST_F(OneClaim, DifferenceSaysByHowMuch) {
  metrics_ = {{"m", "B", {110}}, {"n", "B", {100}}, {"zero", "B", {0}}};
  const auto text = [&](const std::string& check) { return judge_one(check).measured; };
  EXPECT_THAT(text("{within = [\"e/c/m\"], range = [90, 100]}"), HasSubstr("but 10 % above"));
  EXPECT_THAT(text("{ratio = [\"e/c/m\", \"e/c/n\"], range = [2.2, 3]}"), HasSubstr("but 50 % below"));
  EXPECT_THAT(text("{equal = [\"e/c/m\", 100]}"), HasSubstr("≠ 100 (10 % above)"));
  EXPECT_THAT(text("{within = [\"e/c/m\"], range = [1, 2]}"), HasSubstr("but 55 times that"));
  EXPECT_THAT(text("{order = [\"e/c/m\", \"e/c/n\"]}"), HasSubstr("≥ n 100 B (10 % above)"));
  EXPECT_THAT(text("{within = [\"e/c/m\"], range = [-1, 0]}"), HasSubstr("but 110 above"));
  EXPECT_THAT(text("{ratio = [\"e/c/m\", \"e/c/zero\"], range = [0, 1]}"),
              HasSubstr("at no finite distance"));
}

// The short form: the figure that decides, what it must be, its name.
TEST_F(OneClaim, TheFirstFailingConditionDecides) {
  metrics_ = {{"m_n", "B", {110}}, {"n", "B", {100}}, {"t", "s", {0.5}}};
  const auto deciding = [&](const std::string& check) {
    const ConditionResult found = judge_one(check).deciding;
    return found.value + " | " + found.expected + " | " + found.quantity;
  };
  EXPECT_EQ(deciding("{within = [\"e/c/m_n\"], range = [90, 100]}"), "110 B | [90, 100] | m n");
  EXPECT_EQ(deciding("{ratio = [\"e/c/m_n\", \"e/c/n\"], range = [1, 2]}"), "1.1 | [1, 2] | m n ÷ n");
  EXPECT_EQ(deciding("{equal = [\"e/c/m_n\", 110]}"), "110 B | = 110 | m n");
  EXPECT_EQ(deciding("{order = [\"e/c/n\", \"e/c/m_n\", 109]}"), "110 B | < 109 | m n");
  EXPECT_EQ(deciding("{order = [1, \"e/c/t\", 2]}"), "0.5 s | > 1 | t");
  EXPECT_EQ(deciding("{equal = [\"e/c/n\", 100]}, {equal = [\"e/c/t\", 1]}"), "0.5 s | = 1 | t");
  EXPECT_EQ(deciding("{equal = [\"e/c/n\", 1]}, {equal = [\"e/c/other\", 1]}"), "not measured |  | other");
  EXPECT_EQ(deciding("{figure = \"p.F1\"}"), "not drawn |  | picture");
}

TEST_F(OneClaim, OfConditionsThatHoldTheNearestToItsBoundDecides) {
  metrics_ = {
      {"m", "B", {110}}, {"n", "B", {100}}, {"few", "1/s", {3}}, {"share", "", {0}}, {"all", "", {1}}};
  const auto deciding = [&](const std::string& check, const std::string& type = "E") {
    const Judgement judged = judge_one(check, type);
    const ConditionResult& found = judged.deciding;
    return fmt::format("{} | {} | {} | {}", judged.deciding_condition, found.value, found.expected,
                       found.quantity);
  };
  const std::string wide = R"({within = ["e/c/m"], range = [1, 1000]})",
                    above = R"({order = [2.9, "e/c/few"]})", equal = R"({equal = ["e/c/n", 100]})";
  EXPECT_EQ(deciding(wide + ", " + above), "1 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(above + ", " + wide), "0 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(wide + R"(, {ratio = ["e/c/m", "e/c/n"], range = [1.09, 9]}, )" + above),
            "1 | 1.1 | [1.09, 9] | m ÷ n");
  // Of a chain, the nearest pair.
  EXPECT_EQ(deciding(R"({order = [1, "e/c/n", "e/c/m", 1000]})"), "0 | 100 B | < 110 B | n");
  // The best possible share is not near its bound.
  EXPECT_EQ(deciding(R"({within = ["e/c/share"], range = [0, 0.2]}, )" + wide), "1 | 110 B | [1, 1000] | m");
  const std::string all = R"({within = ["e/c/all"], range = [0.85, 1]})";
  EXPECT_EQ(deciding(all + ", " + above), "1 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(wide + ", " + all), "1 | 1 | [0.85, 1] | all");
  // An equality decides only as the first of an exact claim or if no other has margin; what fails always
  // does.
  const std::string positive = R"({order = [0, "e/c/few"]})";
  EXPECT_EQ(deciding(equal + ", " + above), "0 | 100 B | = 100 | n");
  EXPECT_EQ(deciding(equal + ", " + above, "T"), "1 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(equal + ", " + wide + ", " + above, "T"), "2 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(equal + ", " + positive, "T"), "0 | 100 B | = 100 | n");
  EXPECT_EQ(deciding(positive, "T"), "0 | 3 1/s | > 0 | few");
  EXPECT_EQ(deciding(above + ", " + equal), "0 | 3 1/s | > 2.9 | few");
  EXPECT_EQ(deciding(equal + ", " + above + R"(, {order = ["e/c/m", "e/c/n"]})"), "2 | 110 B | < 100 B | m");
}

TEST_F(OneClaim, RoomIsTheDistanceToTheNearerBoundThatCounts) {
  constexpr double kNone = -1;
  const auto margin = [&](double value, const std::string& range, const char* kind = "ratio") {
    metrics_ = {{"m", "", {value}}, {"one", "", {1}}};
    const std::string operands = kind == std::string("ratio") ? "\"e/c/m\", \"e/c/one\"" : "\"e/c/m\"";
    return judge_one(fmt::format("{{{} = [{}], range = [{}]}}", kind, operands, range), "T")
        .deciding.margin.value_or(kNone);
  };
  for (const auto& [value, range, expected] :
       std::vector<std::tuple<double, const char*, double>>{{0.5, "0.5, 2", 0},
                                                            {2, "0.5, 2", 0},
                                                            {1, "0.5, 2", 0.5},
                                                            {1000, "1, 1e9", 0.999},
                                                            {-0.5, "-1, 1", 0.5},
                                                            {4, "1, 1e300", 0.75},
                                                            {1, "-1e300, 4", 0.75},
                                                            {0, "0, 4", 1},
                                                            {1, "0.85, 1", 0},
                                                            {1, "1, 1", kNone}}) {
    EXPECT_NEAR(margin(value, range), expected, 1e-9) << value << " in " << range;
  }
  EXPECT_NEAR(margin(1, "0.85, 1", "within"), 0.15, 1e-9) << "1 is the best share";
  EXPECT_NEAR(judge_one("{order = [1, \"e/c/m\", 100]}", "T").deciding.margin.value_or(kNone), kNone, 1e-9);
  metrics_ = {{"m", "", {4}}};
  EXPECT_NEAR(judge_one("{order = [1, \"e/c/m\", 100]}", "T").deciding.margin.value_or(kNone), 0.75, 1e-9);
}

TEST_F(OneClaim, RatiosAcrossMachinesOrBuildsAreRefused) {
  metrics_ = {{"t", "s", {1}}, {"bytes", "B", {8}}, {"share", "", {1}, true}};
  const std::string growth = "{growth = [\"e/c/t\", \"e/d/t\"], range = [6.5, 9.5]}";
  Provenance other = fake_provenance();
  const auto check_failure = [&](const std::string& check) {
    other.id = digest(other);
    other_runs_ = {{other, {{"t", "s", {8}}, {"bytes", "B", {8}}, {"share", "", {2}, true}}}};
    return judge_one(check, "S").check_failure;
  };
  other.time = "another day";
  EXPECT_EQ(check_failure(growth), "");
  other.threads = 1;
  EXPECT_THAT(check_failure(growth), HasSubstr("measured on different machines or builds"));
  EXPECT_THAT(check_failure("{ratio = [\"e/d/t\", \"e/c/t\"], range = [6.5, 9.5]}"),
              HasSubstr("different machines or builds"));
  EXPECT_THAT(check_failure("{order = [\"e/c/t\", \"e/d/t\"]}"), HasSubstr("different machines or builds"));
  const std::string bytes = "{ratio = [\"e/c/bytes\", \"e/d/bytes\"], range = [1, 1]}";
  EXPECT_EQ(check_failure("{equal = [\"e/c/bytes\", \"e/d/bytes\"]}"), "") << "bytes are the same everywhere";
  EXPECT_EQ(check_failure(bytes), "");
  const std::string shares = "{order = [\"e/c/share\", \"e/d/share\"]}";
  EXPECT_THAT(check_failure(shares), HasSubstr("different machines or builds")) << "computed from times";
  other.git_revision = "fedcba";
  EXPECT_THAT(check_failure(bytes), HasSubstr("different machines or builds"))
      << "but not of another revision";
  for (auto change : {+[](Provenance& p) { p.cpu = "another"; }, +[](Provenance& p) { p.flags = "-O0"; },
                      +[](Provenance& p) { p.simd = "none"; }, +[](Provenance& p) { p.compiler = "Clang"; },
                      +[](Provenance& p) { p.git_revision = "fedcba"; }}) {
    other = fake_provenance();
    change(other);
    EXPECT_NE(check_failure(growth), "");
  }
}

TEST_F(OneClaim, DivisionByZeroLiesInNoRange) {
  metrics_ = {{"m", "", {0}}, {"n", "", {1}}};
  EXPECT_EQ(verdict("{ratio = [\"e/c/n\", \"e/c/m\"], range = [-1e300, 1e300]}"), Verdict::kDiffers);
  EXPECT_EQ(verdict("{ratio = [\"e/c/m\", \"e/c/m\"], range = [-1e300, 1e300]}"), Verdict::kDiffers);
}

TEST_F(OneClaim, MissingMeasurementFails) {
  const Judgement found = judge_one("{equal = [\"e/other/m\", 1]}");
  EXPECT_EQ(found.verdict, Verdict::kMissing);
  EXPECT_THAT(found.check_failure, HasSubstr("missing"));
  EXPECT_THAT(found.measured, HasSubstr("no m of e other was measured"));
}

TEST_F(OneClaim, KnownDifferenceDoesNotFailAndAnEndToItDoes) {
  metrics_ = {{"m", "", {2}}};
  const std::string known = "fails = [\"e/c/m = *\"]\nnote = \"n\"\nmatches = \"None does.\"\n";
  EXPECT_EQ(judge_one("{equal = [\"e/c/m\", 3]}", "E", known).check_failure, "");
  EXPECT_EQ(judge_one("{equal = [\"e/c/m\", 2]}", "E", known).check_failure,
            "holds and was known to fail: m 2 = 2");
}

TEST_F(OneClaim, AKnownDifferenceExcusesNoOtherCondition) {
  metrics_ = {{"m", "", {2}}, {"n", "", {5}}};
  const std::string known =
      "fails = [\"e/c/m = 3\", \"e/c/n in *\"]\nnote = \"n\"\nmatches = \"None does.\"\n";
  const std::string failing = "{equal = [\"e/c/m\", 3]}, {within = [\"e/c/n\"], range = [6, 7]}";
  EXPECT_EQ(judge_one(failing + ", {order = [1, \"e/c/m\"]}", "E", known).check_failure, "");
  const Judgement broken = judge_one(failing + ", {order = [2, \"e/c/m\"]}", "E", known);
  EXPECT_EQ(broken.verdict, Verdict::kDiffers);
  EXPECT_THAT(broken.check_failure, HasSubstr("fails and must hold: 2 ≥ m 2"));
  // One of two known failures has ended: the verdict is the same, the claim is not.
  const Judgement ended =
      judge_one("{equal = [\"e/c/m\", 3]}, {within = [\"e/c/n\"], range = [4, 7]}", "E", known);
  EXPECT_EQ(ended.verdict, Verdict::kDiffers);
  EXPECT_THAT(ended.check_failure, HasSubstr("holds and was known to fail: n 5, in [4, 7]"));
  EXPECT_NE(judge_one(failing + ", {order = [1, \"e/c/other\"]}", "E", known).check_failure, "") << "missing";
}

// Such a condition may hold or fail without failing the check, but it must have been measured.
TEST_F(OneClaim, ConditionsThatDependOnTheMachineMayFailAndNoOthers) {
  metrics_ = {{"m", "", {2}}};
  const std::string machine =
      "may_fail = [\"e/c/* = *\"]\nmachine = \"Caches differ.\"\nprofiles = [\"quick\", \"\"]\n";
  const Judgement differs = judge_one("{equal = [\"e/c/m\", 3]}", "E", machine);
  EXPECT_EQ(differs.verdict, Verdict::kDiffers);
  EXPECT_EQ(differs.check_failure, "");
  EXPECT_EQ(differs.claim->expected(), Verdict::kReproduced);
  EXPECT_EQ(differs.claim->reason(), "Caches differ.");
  EXPECT_EQ(differs.claim->profiles, std::vector<std::string>{"quick"});
  const Judgement holds = judge_one("{equal = [\"e/c/m\", 2]}", "E", machine);
  EXPECT_EQ(holds.verdict, Verdict::kReproduced);
  EXPECT_EQ(holds.check_failure, "");
  const Judgement broken = judge_one("{equal = [\"e/c/m\", 3]}, {order = [3, \"e/c/m\"]}", "E", machine);
  EXPECT_EQ(broken.check_failure, "fails and must hold: 3 ≥ m 2 (50 % above)");
  const Judgement both =
      judge_one("{equal = [\"e/c/m\", 3]}, {order = [3, \"e/c/m\"]}", "E",
                machine + "fails = [\"3 < e/c/m\"]\nnote = \"First. Second.\"\nmatches = \"None does.\"\n");
  EXPECT_EQ(both.check_failure, "");
  EXPECT_EQ(both.claim->reason(), "First.");
  const Judgement missing = judge_one("{equal = [\"e/c/other\", 2]}", "E", machine);
  EXPECT_EQ(missing.verdict, Verdict::kMissing);
  EXPECT_NE(missing.check_failure, "");
}

TEST_F(OneClaim, FigureMustBeThereDecodeAndShowSomething) {
  const std::string check = "{figure = \"p.F1\"}";
  EXPECT_EQ(verdict(check, "F"), Verdict::kMissing);
  const auto drawn = [&] { figures_[0].checksum = checksum(read_file(folder_ / "figures/f.png")); };
  figures_ = {{"p.F1", "figures/f.png", "", ""}};
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers) << "the file is not there";
  write_file(folder_ / "figures/f.png", std::string_view("no picture"));
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers);
  Image image(8, 8, {10, 20, 30});
  write_picture(folder_ / "figures/f.png", image);
  drawn();
  EXPECT_THAT(judge_one(check, "F").measured, HasSubstr("blank"));
  image.set(7, 7, {10, 20, 61});
  write_picture(folder_ / "figures/f.png", image);
  EXPECT_THAT(judge_one(check, "F").measured, HasSubstr("is not the picture that was drawn"));
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers);
  drawn();
  EXPECT_EQ(verdict(check, "F"), Verdict::kReproduced);
}

}  // namespace
}  // namespace terrabench
