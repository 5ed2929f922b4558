#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "results/report/report.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string entries() {
  const std::string page = "each = [\"ground\"]\npage = \"{ground}\"\n",
                    row = R"({label = "l", case = "{ground}"})",
                    bytes = R"({title = "Bytes", unit = "B", metric = "bytes"})";
  return "[sets]\nground = [\"hill\", \"cave\"]\n" + claim_entry("p.1", R"({equal = ["e/hill/n", 3]})") +
         R"([[page]]
each = ["ground"]
id = "{ground}"
about = "A <{ground}> & more."
sheets = ["e/{ground}/maps"]
pictures = ["e/{ground}/view", "e/{ground}/not-drawn"]
)" +
         table_entry("p.size-{ground}", R"({label = "l", case = "{ground}", claim = "p.1"})",
                     bytes + R"(, {title = "Verdict", verdict = "claim"})", page) +
         table_entry("p.both", R"({each = ["ground"], label = "l", case = "{ground}"})", bytes) +
         table_entry("p.time-{ground}", row, R"({title = "Time", unit = "s", metric = "time"})", page) +
         plot_entry("p.plot-{ground}",
                    R"({label = "l", experiment = "e", metric = "n", cases = [[1, "{ground}"]]})", page);
}

class GroundPageTest : public FolderTest {
 protected:
  GroundPageTest() : store_(folder_), papers_{paper_of(entries())} { store_.begin_run(run_); }

  void measure(const std::string& ground) {
    Record record = fake_record(run_, "e", ground);
    add(record, "bytes", "B", {1000});
    add(record, "time", "s", {2});
    add(record, "n", "", {3});
    store_.append(record);
    for (const char* const kind : {"maps", "view"}) {
      Record drawing = fake_record(run_, "e", fmt::format("{}/{}", ground, kind));
      const std::string id = fmt::format("p.{}-{}", kind, ground), file = "figures/" + id + ".png";
      write_picture(folder_ / file, Image(40, 20, {200, 40, 40}));
      drawing.figures.push_back({id, file, "Picture.", checksum(read_file(folder_ / file))});
      store_.append(drawing);
    }
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_ / "report" / name); }
  std::string written(const std::string& name) const { return read_file(folder_ / "report" / name); }

  Provenance run_ = fake_provenance();
  Store store_;
  std::vector<Paper> papers_;
};

TEST_F(GroundPageTest, HoldsAllThatBelongsToItsGroundAndNothingOfAnother) {
  for (const char* const ground : {"hill", "cave"}) measure(ground);
  write_report(store_, papers_);
  for (const auto& [ground, other] : {std::pair{"hill", "cave"}, std::pair{"cave", "hill"}}) {
    for (const char* const form : {"html", "md"}) {
      const std::string page = written(fmt::format("ground-{}.{}", ground, form));
      std::size_t at = 0;
      for (const char* const part :
           {"Ground {}", "Measured in profile", "id=\"p.size-{}\"", "id=\"p.time-{}\"", "figures/p.plot-{}.",
            "../figures/p.maps-{}.png", "../figures/p.view-{}.png"}) {
        const std::string text = fmt::format(fmt::runtime(part), ground);
        EXPECT_NE(page.find(text, at), page.npos)
            << ground << "." << form << " has no " << text << " in its place";
        at = std::min(page.size(), page.find(text, at));
      }
      for (const char* const part : {"size", "time", "plot", "maps", "view"})
        EXPECT_THAT(page, Not(HasSubstr(fmt::format("p.{}-{}", part, other))));
      EXPECT_THAT(page, Not(HasSubstr("p.both")));
    }
  }
  EXPECT_THAT(written("ground-hill.html"), HasSubstr("<p>A &lt;hill&gt; &amp; more.</p>"));
}

TEST_F(GroundPageTest, IsListedWhereItsTablesWouldStand) {
  for (const char* const ground : {"hill", "cave"}) measure(ground);
  write_report(store_, papers_);
  const std::string page = written("paper-p.html");
  EXPECT_THAT(page, HasSubstr("id=\"p.both\""));
  for (const char* const ground : {"hill", "cave"}) {
    EXPECT_THAT(page, HasSubstr(fmt::format("href=\"ground-{}.html\"", ground)));
    EXPECT_THAT(written("paper-p.md"), HasSubstr(fmt::format("(ground-{}.md)", ground)));
    EXPECT_THAT(page, Not(HasSubstr(fmt::format("p.size-{}", ground))));
    EXPECT_THAT(page, Not(HasSubstr(fmt::format("p.plot-{}", ground))));
    EXPECT_THAT(written("ledger.html"), HasSubstr(fmt::format("href=\"ground-{}.html\"", ground)));
    EXPECT_THAT(written("ledger.md"), HasSubstr(fmt::format("(ground-{}.md)", ground)));
    EXPECT_TRUE(has(fmt::format("tables/p.size-{}.csv", ground)));
  }
}

TEST_F(GroundPageTest, TheLedgerLeadsToATableWithVerdictsOnIt) {
  for (const char* const ground : {"hill", "cave"}) measure(ground);
  write_report(store_, papers_);
  EXPECT_THAT(written("ground-hill.html"), HasSubstr("class=\"verdict reproduced\""));
  EXPECT_THAT(written("ground-hill.md"), HasSubstr("reproduced"));
  EXPECT_THAT(written("ledger.html"), HasSubstr("href=\"ground-hill.html#p.size-hill\""));
  EXPECT_THAT(written("ledger.md"), HasSubstr("(ground-hill.md#p.size-hill)"));
}

TEST_F(GroundPageTest, AGroundThatWasNotMeasuredHasNone) {
  measure("hill");
  write_report(store_, papers_);
  EXPECT_TRUE(has("ground-hill.html"));
  EXPECT_FALSE(has("ground-cave.html"));
  EXPECT_THAT(written("index.html"), Not(HasSubstr("ground-cave")));
  EXPECT_THAT(written("ledger.html"), Not(HasSubstr("ground-cave")));
}

TEST_F(GroundPageTest, WarnsOfAlteredResults) {
  measure("hill");
  edit(file(), "\"seed\":1", "\"seed\":2");
  write_report(Store::open(folder_), papers_);
  EXPECT_THAT(written("ground-hill.html"), HasSubstr("cannot be trusted"));
  EXPECT_THAT(written("ground-hill.md"), HasSubstr("cannot be trusted"));
}

// Each page warns of its own ground alone. A hundredth of the columns is many.
TEST_F(GroundPageTest, WarnsOfManyLostColumns) {
  for (const auto& [ground, lost] : {std::pair{"hill", 250.0}, std::pair{"cave", 5.0}}) {
    measure(ground);
    Record record = fake_record(run_, "e", ground);
    add(record, "bytes", "B", {1000});
    add(record, "n", "", {3});
    add(record, "columns", "", {1000 - lost});
    add(record, "lost_columns", "", {lost});
    store_.append(record);
  }
  write_report(store_, papers_);
  for (const char* const form : {"html", "md"}) {
    EXPECT_THAT(written(fmt::format("ground-hill.{}", form)),
                HasSubstr("up to 25.0 % of the columns (case hill)"));
    EXPECT_THAT(written(fmt::format("ground-cave.{}", form)), Not(HasSubstr("leave out columns")));
  }
}

std::string ground_of(const std::string& case_name) { return case_name.substr(0, case_name.find('/')); }

// The page where cases of these grounds belong; empty: the paper's page.
std::string page_for(const Paper& paper, const std::set<std::string>& grounds) {
  if (grounds.size() != 1) return "";
  const std::string& ground = *grounds.begin();
  return std::ranges::count(paper.pages, ground, &PageLayout::id) > 0 ? ground : "";
}

TEST(GroundPages, HaveEveryTableAndPlotWhoseCasesAreAllOnThatGround) {
  std::size_t tables = 0, plots = 0;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) {
      std::set<std::string> grounds;
      for (const TableLayout::Row& row : table.rows) grounds.insert(ground_of(row.case_name));
      EXPECT_EQ(table.page, page_for(paper, grounds)) << table.id;
      tables += table.page.empty() ? 0 : 1;
    }
    for (const PlotLayout& plot : paper.plots) {
      std::set<std::string> grounds;
      for (const PlotLayout::Series& series : plot.series) {
        for (const auto& [x, case_name] : series.cases) grounds.insert(ground_of(case_name));
      }
      // Parts of frames stand beside their table, which is of several grounds.
      const bool parts = plot.id.starts_with("cross.lod-frames.bars");
      EXPECT_EQ(plot.page, parts ? "" : page_for(paper, grounds)) << plot.id;
      plots += plot.page.empty() ? 0 : 1;
    }
  }
  EXPECT_GE(tables, 50U);
  EXPECT_GE(plots, 11U);
}

TEST(GroundPages, HaveEverySheetThatShowsNumbersOfThatGround) {
  std::size_t sheets = 0;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      for (const Condition& condition : claim.conditions) {
        std::set<std::string> grounds;
        for (const Operand& operand : condition.operands) grounds.insert(ground_of(operand.case_name));
        const std::string ground = page_for(paper, grounds);
        if (condition.kind != Condition::Kind::kFigure || ground.empty()) continue;
        const auto page = std::ranges::find(paper.pages, ground, &PageLayout::id);
        for (const Operand& operand : condition.operands) {
          const auto draws = [&](const PageLayout::Drawn& sheet) {
            return sheet.experiment == operand.experiment && sheet.case_name == operand.case_name;
          };
          EXPECT_TRUE(std::ranges::any_of(page->sheets, draws)) << claim.id;
        }
        ++sheets;
      }
    }
  }
  EXPECT_GE(sheets, 8U) << "error maps of five grounds and wireframes of three";
}

}  // namespace
}  // namespace terrabench
