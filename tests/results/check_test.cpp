#include "results/check.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "results/record_json.h"
#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

using CheckTest = FolderTest;

const Row& row(const CheckReport& report, std::string_view id) {
  const auto it =
      std::find_if(report.rows.begin(), report.rows.end(), [&](const Row& r) { return r.claim->id == id; });
  if (it == report.rows.end()) throw std::runtime_error("no such row");
  return *it;
}

// One claim with this check, measured against one record with these metrics.
class OneClaim : public FolderTest {
 protected:
  Row judge(const std::string& check, const std::string& type = "E", const std::string& more = "") {
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
    papers_ = {
        parse_claims("paper = \"p\"\ntitle = \"t\"\nsource = \"s\"\n[[claim]]\nid = \"p.1\"\nwhere = \"w\"\n"
                     "statement = \"s\"\nclass = \"" +
                         type + "\"\ncheck = [" + check + "]\n" + more,
                     "x")};
    return terrabench::check(store, papers_).rows.at(0);
  }
  Verdict verdict(const std::string& check, const std::string& type = "E") {
    return judge(check, type).verdict;
  }

  std::vector<Metric> metrics_;
  std::vector<Figure> figures_;
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

TEST_F(OneClaim, ShapeRowsSayShape) {
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
    const Row row = judge("{within = [\"e/c/" + metric + "\"], range = [1, 1.5]}", "T");
    return std::pair(row.verdict, row.measured);
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
  const auto text = [&](const std::string& check) { return judge(check).measured; };
  EXPECT_THAT(text("{within = [\"e/c/m\"], range = [90, 100]}"), HasSubstr("but 10 % above"));
  EXPECT_THAT(text("{ratio = [\"e/c/m\", \"e/c/n\"], range = [2.2, 3]}"), HasSubstr("but 50 % below"));
  EXPECT_THAT(text("{equal = [\"e/c/m\", 100]}"), HasSubstr("≠ 100 (10 % above)"));
  EXPECT_THAT(text("{order = [\"e/c/m\", \"e/c/n\"]}"), HasSubstr("≥ n 100 B (10 % above)"));
  EXPECT_THAT(text("{within = [\"e/c/m\"], range = [-1, 0]}"), HasSubstr("but 110 above"));
  EXPECT_THAT(text("{ratio = [\"e/c/m\", \"e/c/zero\"], range = [0, 1]}"), HasSubstr("without measure"));
}

TEST_F(OneClaim, RatiosAcrossMachinesOrBuildsAreRefused) {
  metrics_ = {{"t", "s", {1}}, {"bytes", "B", {8}}};
  const std::string growth = "{growth = [\"e/c/t\", \"e/d/t\"], range = [6.5, 9.5]}";
  Provenance other = fake_provenance();
  const auto complaint = [&](const std::string& check) {
    other.id = digest(other);
    other_runs_ = {{other, {{"t", "s", {8}}, {"bytes", "B", {8}}}}};
    return judge(check, "S").complaint;
  };
  other.time = "another day";
  EXPECT_EQ(complaint(growth), "");
  other.threads = 1;
  EXPECT_THAT(complaint(growth), HasSubstr("measured on different machines or builds"));
  EXPECT_THAT(complaint("{ratio = [\"e/d/t\", \"e/c/t\"], range = [6.5, 9.5]}"),
              HasSubstr("different machines or builds"));
  EXPECT_THAT(complaint("{order = [\"e/c/t\", \"e/d/t\"]}"), HasSubstr("different machines or builds"));
  EXPECT_EQ(complaint("{equal = [\"e/c/bytes\", \"e/d/bytes\"]}"), "") << "bytes are the same everywhere";
  for (auto change : {+[](Provenance& p) { p.cpu = "another"; }, +[](Provenance& p) { p.flags = "-O0"; },
                      +[](Provenance& p) { p.simd = "none"; }, +[](Provenance& p) { p.compiler = "Clang"; },
                      +[](Provenance& p) { p.git_revision = "fedcba"; }}) {
    other = fake_provenance();
    change(other);
    EXPECT_NE(complaint(growth), "");
  }
}

TEST_F(OneClaim, DivisionByZeroLiesInNoRange) {
  metrics_ = {{"m", "", {0}}, {"n", "", {1}}};
  EXPECT_EQ(verdict("{ratio = [\"e/c/n\", \"e/c/m\"], range = [-1e300, 1e300]}"), Verdict::kDiffers);
  EXPECT_EQ(verdict("{ratio = [\"e/c/m\", \"e/c/m\"], range = [-1e300, 1e300]}"), Verdict::kDiffers);
}

TEST_F(OneClaim, MissingMeasurementFails) {
  const Row found = judge("{equal = [\"e/other/m\", 1]}");
  EXPECT_EQ(found.verdict, Verdict::kMissing);
  EXPECT_THAT(found.complaint, HasSubstr("missing"));
  EXPECT_THAT(found.measured, HasSubstr("no m of e other was measured"));
}

TEST_F(OneClaim, KnownDifferenceDoesNotFailAndAnEndToItDoes) {
  metrics_ = {{"m", "", {2}}};
  const std::string known = "known = \"differs\"\nnote = \"n\"\n";
  EXPECT_EQ(judge("{equal = [\"e/c/m\", 3]}", "E", known).complaint, "");
  EXPECT_NE(judge("{equal = [\"e/c/m\", 2]}", "E", known).complaint, "");
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
  write_png(folder_ / "figures/f.png", image);
  drawn();
  EXPECT_THAT(judge(check, "F").measured, HasSubstr("blank"));
  image.set(7, 7, {10, 20, 31});
  write_png(folder_ / "figures/f.png", image);
  EXPECT_THAT(judge(check, "F").measured, HasSubstr("is not the picture that was drawn"));
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers);
  drawn();
  EXPECT_EQ(verdict(check, "F"), Verdict::kReproduced);
}

TEST_F(CheckTest, WholeRunsPassInBothProfiles) {
  for (const char* profile : {"quick", "paper"}) {
    std::filesystem::remove(file());
    write_fake_results(folder_, profile);
    const CheckReport report = check(Store::open(folder_), faked_papers());
    EXPECT_TRUE(report.passed()) << check_text(report, false);
    EXPECT_EQ(report.profile, profile);
    EXPECT_EQ(row(report, "hybrid.T1.128").verdict, Verdict::kReproduced);
    EXPECT_EQ(row(report, "hybrid.T2.256").verdict, Verdict::kShape);
    EXPECT_EQ(row(report, "hybrid.F13").verdict, Verdict::kReproduced);
    EXPECT_EQ(row(report, "hybrid.T3").verdict, Verdict::kPending);
    const Verdict large = profile == std::string("paper") ? Verdict::kReproduced : Verdict::kNotRun;
    EXPECT_EQ(row(report, "hybrid.T1.512").verdict, large);
  }
}

TEST_F(CheckTest, AFigureAlteredByHandFailsItsRowEvenInsideTheTolerance) {
  write_fake_results(folder_, "quick");
  edit(file(), "\"stack_heap_bytes\",\"samples\":[213040.0]", "\"stack_heap_bytes\",\"samples\":[213041.0]");
  const CheckReport report = check(folder_);
  EXPECT_FALSE(report.passed());
  EXPECT_THAT(row(report, "hybrid.T1.128").complaint, HasSubstr("altered"));
  EXPECT_EQ(row(report, "hybrid.T1.256").complaint, "");
  EXPECT_THAT(check_text(report, false), HasSubstr("FAIL"));
}

TEST_F(CheckTest, PictureAlteredByHandIsAFault) {
  write_fake_results(folder_, "quick");
  // Even one that no row asks for.
  Image image(8, 8, {10, 20, 30});
  write_png(folder_ / "figures/relief.jacksboro.heightmap.png", image);
  const CheckReport report = check(folder_);
  ASSERT_EQ(report.faults.size(), 1U);
  EXPECT_THAT(report.faults[0], HasSubstr("relief.jacksboro.heightmap.png: picture altered"));
  EXPECT_FALSE(report.passed());
}

TEST_F(CheckTest, RowsAreChosenByGlob) {
  write_fake_results(folder_, "quick");
  const auto ids = [&](const std::vector<std::string>& globs) {
    std::vector<std::string> found;
    for (const Row& row : check(folder_, globs).rows) found.push_back(row.claim->id);
    return found;
  };
  EXPECT_THAT(ids({"hybrid.T1.*.128", "hybrid.T2.25?"}),
              testing::ElementsAre("hybrid.T1.voxels.128", "hybrid.T1.ratio.128", "hybrid.T2.256"));
  EXPECT_EQ(ids({}).size(), claims().size());
  const std::vector<std::string> wrong = {"hybrid.T1.128", "hybrid.t9*"};
  try {
    check(folder_, wrong);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), HasSubstr("hybrid.t9*"));
  }
}

TEST_F(CheckTest, PartialRunFailsForWhatItsProfileShouldHold) {
  write_fake_results(folder_, "quick");
  std::string text = content();
  write_file(file(), text.substr(0, text.find("hybrid.caves")));
  const CheckReport report = check(folder_);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(row(report, "hybrid.caves").verdict, Verdict::kMissing);
  EXPECT_EQ(row(report, "hybrid.T1.128").complaint, "");
}

TEST_F(CheckTest, EmptyOrGarbledFolderIsBadInput) {
  for (const char* text : {"", "\n\n", "garbage\n", "{\"kind\":\"run\"}\n"}) {
    write_file(file(), std::string_view(text));
    try {
      check(folder_);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kBadInput);
    }
  }
}

TEST_F(CheckTest, TextIsColouredOnATerminalOnly) {
  write_fake_results(folder_, "quick");
  const CheckReport report = check(Store::open(folder_), faked_papers());
  EXPECT_THAT(check_text(report, false), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(check_text(report, true), HasSubstr("\x1b[32mreproduced"));
  EXPECT_THAT(check_text(report, false), HasSubstr("PASS"));
}

TEST_F(CheckTest, JsonAndJunitHoldEveryRow) {
  write_fake_results(folder_, "quick");
  edit(file(), "\"overhang_columns\",\"samples\":[0.0]", "\"overhang_columns\",\"samples\":[5.0]");
  const CheckReport report = check(Store::open(folder_), faked_papers());
  const auto json = nlohmann::json::parse(check_json(report));
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["rows"].size(), report.rows.size());
  EXPECT_EQ(json["rows"][0]["id"], "hybrid.T1.128");
  EXPECT_EQ(json["rows"][0]["reported"][0], 393216);
  const std::string junit = check_junit(report);
  const auto count = [&](std::string_view what) {
    std::size_t n = 0;
    for (std::size_t at = junit.find(what); at != junit.npos; at = junit.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<testcase "), report.rows.size() + report.faults.size());
  EXPECT_EQ(count("<failure "), 2U) << "the row and the altered line";
  EXPECT_THAT(junit, HasSubstr("failures=\"2\""));
  EXPECT_THAT(junit, HasSubstr("&lt;"));
}

}  // namespace
}  // namespace terrabench
