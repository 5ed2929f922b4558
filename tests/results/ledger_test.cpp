#include "results/report/ledger.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "results/report/report.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

// Two tables and a plot show metrics of case "c". Nothing shows case "d"; case "absent" is not measured.
std::string shown_entries() {
  return R"([sets]
read = [
  {name = "named", of = "c/bytes"},
  {name = "first", of = "c/count"},
  {name = "of-row", of = "c/drill_error"},
  {name = "plotted", of = "c/time"},
  {name = "unlike", of = "c/unlike"},
  {name = "unshown", of = "d/count"},
  {name = "unmeasured", of = "absent/count"},
]
table = [
  {name = "one", claim = "none", other = "<method>", method = "unmeasured"},
  {name = "two", claim = "p.named", other = "<method>_error", method = "drill"},
]
)" + claim_entry("p.{read}", R"({equal = ["e/{read.of}", 1]})", "each = [\"read\"]\n") +
         claim_entry("p.two", R"({equal = ["e/c/unlike", 1]}, {equal = ["e/c/time", 1]})") +
         table_entry("t.{table}",
                     R"({label = "l", case = "c", claim = "{table.claim}", method = "{table.method}"},
                        {label = "l", case = "absent"})",
                     R"({title = "n", metric = "count"}, {title = "m", metric = "{table.other}"})",
                     "each = [\"table\"]\n") +
         plot_entry("p.plot",
                    R"({label = "l", experiment = "e", metric = "bytes", x_metric = "time", cases = ["c"]})");
}

constexpr std::size_t kVerdict = 1, kPrinted = 3, kMeasured = 4, kTolerance = 5, kWhy = 7, kFigure = 8,
                      kRun = 9;

class LedgerTest : public FolderTest {
 protected:
  LedgerTest() { write_fake_results(folder_, "paper"); }

  Table table(std::span<const Paper> of) const {
    const Store store = Store::open(folder_);
    return ledger_table(store, judge(store, of), of, {.shown = {"hybrid.table1"}});
  }
  // The row with this id; ends the test when there is none.
  static const std::vector<Cell>& row(const Table& table, const std::string& id) {
    const auto at = std::ranges::find_if(table.rows, [&](const auto& cells) { return cells[0].text == id; });
    if (at == table.rows.end()) throw std::runtime_error("no row " + id);
    return *at;
  }
};

TEST_F(LedgerTest, EveryClaimHasARowWithAnAnchorAndNoCellIsEmptyWithoutCause) {
  const Table ledger = table(papers());
  std::size_t claims = 0;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      if (claim.of_profile_scale()) continue;  // not measured here
      ASSERT_EQ(ledger.rows[claims][0].text, claim.id);
      EXPECT_EQ(ledger.rows[claims][0].anchor, claim.id);
      const bool good = ledger.rows[claims][kVerdict].text.starts_with("reproduced");
      EXPECT_EQ(ledger.rows[claims][kWhy].text.empty(), good) << claim.id;
      EXPECT_FALSE(good && ledger.rows[claims][kTolerance].text.empty()) << claim.id;
      ++claims;
    }
  }
  EXPECT_EQ(ledger.rows.size(), claims);
}

TEST_F(LedgerTest, ARowSaysWhatWasPrintedAndMeasuredAndWhere) {
  const Table ledger = table(papers());
  const auto& exact = row(ledger, "hybrid.T1.512");
  EXPECT_EQ(exact[kPrinted].text, "6,291,456 B");
  EXPECT_THAT(exact[kMeasured].text, HasSubstr("6,291,456 B"));
  EXPECT_EQ(exact[kFigure].link, "paper-hybrid.*#hybrid.table1");
  const auto& differs = row(ledger, "hybrid.T2.ten");
  EXPECT_THAT(differs[kWhy].text, HasSubstr("the work grows with n³, by 8. Matches: hybrid.T2.256"));
  // The figure was drawn, but the links know of no such file.
  EXPECT_EQ(row(ledger, "hybrid.F3")[kFigure].link, "");
}

TEST_F(LedgerTest, ARowOfSeveralConditionsShowsTheOneThatDecidesAndWhichItIs) {
  Store store(folder_);
  for (const auto& [name, rate] : {std::pair{"fast", 3.77e6}, std::pair{"slow", 0.27e6}}) {
    Record record = fake_record(fake_provenance(), "e", name, "paper");
    add(record, "rate", "1/s", {rate});
    store.append(record);
  }
  const auto measured = [&](const std::string& check, const std::string& more = "") {
    const std::vector<Paper> of{paper_with_claim("E", check, more)};
    return ledger_table(store, judge(store, of), of, {}).rows[0][kMeasured].text;
  };
  const std::string fast = R"({order = [2e5, "e/fast/rate"]})", slow = R"({order = [2e5, "e/slow/rate"]})",
                    equal = R"({equal = ["e/fast/rate", 3.77e6]})";
  EXPECT_EQ(measured(slow), "rate: 270,000 1/s");
  EXPECT_EQ(measured(fast + ", " + slow),
            "slow rate: 270,000 1/s (condition 2 of 2: the nearest to its bound)");
  EXPECT_EQ(measured(fast + R"(, {order = ["e/slow/rate", 1]})"),
            "slow rate: 270,000 1/s (condition 2 of 2: the first that fails)");
  EXPECT_EQ(measured(equal + ", " + slow), "fast rate: 3,770,000 1/s (condition 1 of 2)");
  EXPECT_EQ(measured(fast + R"(, {order = ["e/none/rate", 1]})"),
            "none rate: not measured (condition 2 of 2)");
  EXPECT_EQ(measured(R"({order = [2e5, "e/none/rate"]})"), "rate: not measured");
  EXPECT_EQ(measured(slow + R"(, {growth = ["e/slow/rate", "e/fast/rate"], range = [13, 14]})"),
            "growth of fast rate: 14 (condition 2 of 2: the nearest to its bound)");
  // Words in place of the bounds: the bound stands beside the figure.
  const std::string words = "tolerance = \"above the floor\"\n";
  EXPECT_EQ(measured(slow, words), "rate: 270,000 1/s");
  EXPECT_EQ(measured(fast + ", " + slow, words),
            "slow rate: 270,000 1/s (condition 2 of 2, > 200,000: the nearest to its bound)");
  EXPECT_EQ(measured(fast + R"(, {order = ["e/none/rate", 1]})", words),
            "none rate: not measured (condition 2 of 2)");
}

TEST_F(LedgerTest, ARunNamesTheLinesThatWereRead) {
  const Store store = Store::open(folder_);
  const Record* const record = store.find("hybrid.table1", "n=512", "paper");
  ASSERT_NE(record, nullptr);
  const Cell run = row(table(papers()), "hybrid.T1.512")[kRun];
  EXPECT_THAT(run.text, HasSubstr(std::to_string(store.line(*record))));
  EXPECT_THAT(run.link, testing::StartsWith("runs.*#run-"));
  const std::string text = content();
  std::size_t at = 0;
  for (std::size_t line = 1; line < store.line(*record); ++line) at = text.find('\n', at) + 1;
  EXPECT_THAT(text.substr(at, text.find('\n', at) - at), HasSubstr("\"n=512\""));
}

TEST_F(LedgerTest, ARowLinksToTheTableOrPlotThatShowsItsNumbers) {
  Store store(folder_);
  for (const char* const name : {"c", "d"}) {
    Record record = fake_record(fake_provenance(), "e", name, "paper");
    for (const char* const metric : {"bytes", "count", "drill_error", "time", "unlike"})
      add(record, metric, "", {1});
    store.append(record);
  }
  const std::vector<Paper> of{paper_of(shown_entries())};
  using Ids = std::set<std::string, std::less<>>;
  const auto shown = [&](const std::string& id, const Ids& in_report = {"t.one", "t.two", "p.plot"}) {
    return row(ledger_table(store, judge(store, of), of, {.shown = in_report}), id)[kFigure].text;
  };
  EXPECT_EQ(shown("p.named"), "t.two") << "the table's row names the claim";
  EXPECT_EQ(shown("p.first"), "t.one");
  EXPECT_EQ(shown("p.first", {"t.two"}), "t.two") << "the report leaves the first out";
  EXPECT_EQ(shown("p.of-row"), "t.two") << "the row names the metric";
  EXPECT_EQ(shown("p.plotted"), "p.plot");
  EXPECT_EQ(shown("p.two"), "p.plot") << "the claim's second number is shown, its first is not";
  EXPECT_EQ(shown("p.unlike"), "t.one (same case, other quantities)");
  for (const char* const nowhere : {"p.unshown", "p.unmeasured"}) EXPECT_EQ(shown(nowhere), "–");
  write_report(store, of);
  const auto page = [&](const char* name) { return read_file(folder_ / "report" / name); };
  EXPECT_THAT(page("ledger.html"), HasSubstr("<a href=\"paper-p.html#p.plot\">p.plot</a>"));
  EXPECT_THAT(page("paper-p.html"), HasSubstr("<figure id=\"p.plot\">"));
  EXPECT_THAT(page("ledger.md"), HasSubstr("[p.plot](paper-p.md#p.plot)"));
  EXPECT_THAT(page("paper-p.md"), HasSubstr("<a id=\"p.plot\"></a>"));
}

// Claims that no table or plot shows read these experiments. Each checks one detail by a few numbers of one
// case, which the ledger's row gives itself. A claim that reads another experiment needs a table or plot in
// its claims.toml.
constexpr const char* kInNoTable[] = {"hybrid.sky"};

TEST(Ledger, EveryMeasuredClaimButThoseThatCheckOneDetailHasATableOrPlot) {
  const Store store = Store::open(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference");
  LedgerLinks links;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) links.shown.insert(table.id);
    for (const PlotLayout& plot : paper.plots) links.shown.insert(plot.id);
  }
  const JudgedResults results = judge(store, papers());
  const Table table = ledger_table(store, results, papers(), links);
  std::set<std::string> in_no_table;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i][kFigure].text != "–") continue;
    for (const Condition& condition : results.judgements[i].claim->conditions) {
      for (const Operand& o : condition.operands) {
        if (store.find(o.experiment, o.case_name, store.profile()) != nullptr)
          in_no_table.insert(o.experiment);
      }
    }
  }
  EXPECT_THAT(in_no_table, testing::ElementsAreArray(kInNoTable));
}

// Without the script the field is hidden and no row is.
TEST_F(LedgerTest, AllRowsAreShownWithoutTheScript) {
  write_report(folder_);
  const std::string page = read_file(folder_ / "report/ledger.html");
  EXPECT_THAT(page, HasSubstr("data-table=\"ledger\" data-search hidden>"));
  EXPECT_THAT(page, HasSubstr("<table id=\"ledger\">"));
  EXPECT_THAT(page, Not(HasSubstr("<tr hidden")));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(read_file(folder_ / "report/tables/ledger.csv"), HasSubstr("\r\nhybrid.T1.512,"));
  EXPECT_THAT(read_file(folder_ / "report/ledger.md"),
              HasSubstr("| <a id=\"hybrid.T1.512\"></a>hybrid.T1.512"));
}

}  // namespace
}  // namespace terrabench
