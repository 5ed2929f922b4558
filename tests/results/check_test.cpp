#include "results/check.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "terrain/error.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

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

TEST_F(OneClaim, TimingIsJudgedByItsSpread) {
  metrics_ = {{"steady", "s", {0.96, 0.97, 0.98, 0.97, 0.96}},
              {"spread", "s", {0.90, 0.96, 0.97, 0.98, 1.02, 1.01}},
              {"wild", "s", {0.1, 0.2, 0.9, 5, 9, 0.3}}};
  EXPECT_EQ(verdict("{within = [\"e/c/steady\"], range = [1, 1.5]}", "T"), Verdict::kDiffers);
  EXPECT_EQ(verdict("{within = [\"e/c/spread\"], range = [1, 1.5]}", "T"), Verdict::kReproduced);
  EXPECT_EQ(verdict("{within = [\"e/c/wild\"], range = [1, 1.5]}", "T"), Verdict::kDiffers)
      << "too wide to say anything";
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
  EXPECT_EQ(judge("{equal = [\"e/c/m\", 3]}", "E", "known = \"differs\"\n").complaint, "");
  EXPECT_NE(judge("{equal = [\"e/c/m\", 2]}", "E", "known = \"differs\"\n").complaint, "");
}

TEST_F(OneClaim, FigureMustBeThereDecodeAndShowSomething) {
  const std::string check = "{figure = \"p.F1\"}";
  EXPECT_EQ(verdict(check, "F"), Verdict::kMissing);
  figures_ = {{"p.F1", "figures/f.png", ""}};
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers) << "the file is not there";
  write_file(folder_ / "figures/f.png", std::string_view("no picture"));
  EXPECT_EQ(verdict(check, "F"), Verdict::kDiffers);
  Image image(8, 8, {10, 20, 30});
  write_png(folder_ / "figures/f.png", image);
  EXPECT_THAT(judge(check, "F").measured, HasSubstr("blank"));
  image.set(7, 7, {10, 20, 31});
  write_png(folder_ / "figures/f.png", image);
  EXPECT_EQ(verdict(check, "F"), Verdict::kReproduced);
}

TEST_F(CheckTest, WholeRunsPassInBothProfiles) {
  for (const char* profile : {"quick", "paper"}) {
    std::filesystem::remove(file());
    write_fake_results(folder_, profile);
    const CheckReport report = check(folder_);
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
  const CheckReport report = check(folder_);
  EXPECT_THAT(check_text(report, false), Not(HasSubstr("\x1b[")));
  EXPECT_THAT(check_text(report, true), HasSubstr("\x1b[32mreproduced"));
  EXPECT_THAT(check_text(report, false), HasSubstr("PASS"));
}

TEST_F(CheckTest, JsonAndJunitHoldEveryRow) {
  write_fake_results(folder_, "quick");
  edit(file(), "\"overhang_columns\",\"samples\":[0.0]", "\"overhang_columns\",\"samples\":[5.0]");
  const CheckReport report = check(folder_);
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
