#include "results/report/ledger.h"

#include <gmock/gmock.h>

#include "results/report/report.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::string_view kPlotOnly = R"(paper = "p"
title = "t"
source = "s"
[[claim]]
id = "p.1"
where = "w"
statement = "s"
class = "E"
check = [{equal = ["e/small/n", 2]}]
[[plot]]
id = "p.growth"
title = "Growth"
caption = "c"
x = {label = "x"}
y = {label = "y"}
series = [{label = "l", experiment = "e", metric = "n", cases = [[1, "small"], [2, "large"]]}]
)";

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
  EXPECT_EQ(exact[kFigure].link, "index.html#hybrid.table1");
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
    const std::vector<Paper> of{parse_claims(R"(paper = "p"
title = "t"
source = "s"
[[claim]]
id = "p.1"
where = "w"
statement = "s"
class = "E"
check = [)" + check + "]\n" + more,
                                             "claims.toml")};
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
            "growth of fast rate: 13.96 (condition 2 of 2: the nearest to its bound)");
  // Words in place of the bounds: the bound stands beside the figure.
  const std::string words = "tolerance = \"above the floor\"\n";
  EXPECT_EQ(measured(slow, words), "rate: 270,000 1/s");
  EXPECT_EQ(measured(fast + ", " + slow, words),
            "slow rate: 270,000 1/s (condition 2 of 2, > 200,000: the nearest to its bound)");
  EXPECT_EQ(measured(fast + R"(, {order = ["e/none/rate", 1]})", words),
            "none rate: not measured (condition 2 of 2)");
}

// Searches all tables anew for each number: slow, but it has no index that could be wrong.
TEST_F(LedgerTest, EveryRowWhoseNumbersATableShowsHasAFigureOrTable) {
  const Store store = Store::open(folder_);
  LedgerLinks links;
  for (const Paper& paper : faked_papers()) {
    for (const TableLayout& layout : paper.tables) links.shown.insert(layout.id);
  }
  const Table ledger = ledger_table(store, judge(store, faked_papers()), faked_papers(), links);
  const auto is_shown = [&](const Operand& operand) {
    const Record* const record = store.find(operand.experiment, operand.case_name, "paper");
    if (record == nullptr || record->find(operand.metric) == nullptr) return false;
    for (const Paper& paper : faked_papers()) {
      for (const TableLayout& layout : paper.tables) {
        if (layout.experiment != operand.experiment) continue;
        if (std::ranges::count(layout.rows, operand.case_name, &TableLayout::Row::case_name) == 0) continue;
        if (std::ranges::count(layout.columns, operand.metric, &TableLayout::Column::metric) > 0) return true;
      }
    }
    return false;
  };
  int shown = 0;
  for (const Paper& paper : faked_papers()) {
    for (const Claim& claim : paper.claims) {
      for (const Condition& condition : claim.conditions) {
        if (std::ranges::none_of(condition.operands, is_shown)) continue;
        const Cell& figure = row(ledger, claim.id)[kFigure];
        EXPECT_NE(figure.text, "–") << claim.id;
        EXPECT_THAT(figure.text, Not(HasSubstr("other quantities"))) << claim.id;
        ++shown;
      }
    }
  }
  EXPECT_GT(shown, 0);
}

TEST_F(LedgerTest, ARunNamesTheLinesThatWereRead) {
  const Store store = Store::open(folder_);
  const Record* const record = store.find("hybrid.table1", "n=512", "paper");
  ASSERT_NE(record, nullptr);
  const Cell run = row(table(papers()), "hybrid.T1.512")[kRun];
  EXPECT_THAT(run.text, HasSubstr(std::to_string(store.line(*record))));
  EXPECT_THAT(run.link, testing::StartsWith("index.html#run-"));
  const std::string text = content();
  std::size_t at = 0;
  for (std::size_t line = 1; line < store.line(*record); ++line) at = text.find('\n', at) + 1;
  EXPECT_THAT(text.substr(at, text.find('\n', at) - at), HasSubstr("\"n=512\""));
}

TEST_F(LedgerTest, EveryLinkOfThePageLeadsSomewhere) {
  write_report(folder_);
  const std::string page = read_file(folder_ / "report/ledger.html"),
                    index = read_file(folder_ / "report/index.html");
  EXPECT_THAT(index, HasSubstr("href=\"ledger.html\""));
  int links = 0, pictures = 0;
  constexpr std::string_view kHref = "href=\"";
  for (std::size_t at = page.find(kHref); at != page.npos; at = page.find(kHref, at + 1), ++links) {
    const std::size_t begin = at + kHref.size();
    const std::string target = page.substr(begin, page.find('"', begin) - begin);
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    EXPECT_TRUE(file.empty() || std::filesystem::is_regular_file(folder_ / "report" / file)) << target;
    if (hash != target.npos) {
      EXPECT_THAT(file.empty() ? page : read_file(folder_ / "report" / file),
                  HasSubstr("id=\"" + target.substr(hash + 1) + "\""));
    }
    pictures += target.starts_with("figures/") ? 1 : 0;
  }
  EXPECT_GT(links, 50);
  EXPECT_EQ(pictures, 11);
}

TEST_F(LedgerTest, EveryAnchorThatTheMarkdownPageNamesExists) {
  write_report(folder_);
  const std::string page = read_file(folder_ / "report/ledger.md"),
                    report = read_file(folder_ / "report/report.md");
  int links = 0;
  constexpr std::string_view kLink = "](report.md#";
  for (std::size_t at = page.find(kLink); at != page.npos; at = page.find(kLink, at + 1), ++links) {
    const std::size_t begin = at + kLink.size();
    const std::string id = page.substr(begin, page.find(')', begin) - begin);
    EXPECT_NE(report.find("<a id=\"" + id + "\"></a>"), report.npos) << id;
  }
  EXPECT_GT(links, 20);
}

TEST_F(LedgerTest, ARowWhoseNumbersOnlyAPlotShowsLinksToThePlot) {
  Store store(folder_);
  for (const auto& [name, n] : {std::pair{"small", 2.0}, std::pair{"large", 4.0}}) {
    Record record = fake_record(fake_provenance(), "e", name, "paper");
    add(record, "n", "", {n});
    store.append(record);
  }
  const std::vector<Paper> of{parse_claims(kPlotOnly, "claims.toml")};
  write_report(store, of);
  const auto page = [&](const char* name) { return read_file(folder_ / "report" / name); };
  EXPECT_THAT(page("ledger.html"), HasSubstr("<a href=\"index.html#p.growth\">Growth</a>"));
  EXPECT_THAT(page("index.html"), HasSubstr("<figure id=\"p.growth\">"));
  EXPECT_THAT(page("ledger.md"), HasSubstr("[Growth](report.md#p.growth)"));
  EXPECT_THAT(page("report.md"), HasSubstr("<a id=\"p.growth\"></a>"));
}

// Without the script the field is hidden and no row is.
TEST_F(LedgerTest, AllRowsAreShownWithoutTheScript) {
  write_report(folder_);
  const std::string page = read_file(folder_ / "report/ledger.html");
  EXPECT_THAT(page, HasSubstr("data-table=\"ledger\" hidden>"));
  EXPECT_THAT(page, HasSubstr("<table id=\"ledger\">"));
  EXPECT_THAT(page, Not(HasSubstr("<tr hidden")));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(read_file(folder_ / "report/tables/ledger.csv"), HasSubstr("\r\nhybrid.T1.512,"));
  EXPECT_THAT(read_file(folder_ / "report/ledger.md"),
              HasSubstr("| <a id=\"hybrid.T1.512\"></a>hybrid.T1.512"));
}

}  // namespace
}  // namespace terrabench
