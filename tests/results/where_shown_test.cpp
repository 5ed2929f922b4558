#include "results/report/where_shown.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

// Three tables and a plot show metrics of case "c"; the report leaves out p.whole-table. Nothing shows case
// "d". Case "absent" is not measured.
constexpr std::string_view kClaims = R"(paper = "p"
title = "t"
source = "s"
[[claim]]
each = ["read"]
id = "p.{read}"
where = "w"
statement = "s"
class = "E"
check = [{equal = ["e/{read.of}", 1]}]
[[claim]]
id = "p.two"
where = "w"
statement = "s"
class = "E"
check = [{equal = ["e/c/unlike", 1]}, {equal = ["e/c/time", 1]}]
[[table]]
each = ["table"]
id = "p.{table}-table"
title = "{table.title}"
caption = "c"
experiment = "e"
rows_title = "r"
rows = [{label = "l", case = "c", claim = "{table.claim}", method = "{table.method}"}, {label = "l", case = "absent"}]
columns = [{title = "n", metric = "{table.metric}"}, {title = "m", metric = "{table.other}"}]
[[plot]]
id = "p.plot"
title = "A plot"
caption = "c"
x = {label = "x"}
y = {label = "y"}
series = [{label = "l", experiment = "e", metric = "bytes", x_metric = "time", cases = ["c"]}]
[sets]
read = [
  {name = "named", of = "c/bytes"},
  {name = "first", of = "c/count"},
  {name = "of-row", of = "c/drill_error"},
  {name = "plotted", of = "c/time"},
  {name = "similar", of = "c/time_of_all"},
  {name = "unlike", of = "c/unlike"},
  {name = "unshown", of = "d/count"},
  {name = "unmeasured", of = "absent/count"},
]
table = [
  {name = "whole", title = "Not in the report", claim = "p.first", metric = "unlike", other = "<method>", method = "count"},
  {name = "first", title = "The first", claim = "none", metric = "count", other = "<method>", method = "unmeasured"},
  {name = "second", title = "The second", claim = "p.named", metric = "count", other = "<method>_error", method = "drill"},
]
)";

// What the report contains.
const ShownIds kAll{"p.first-table", "p.second-table", "p.plot"};

class WhereShownTest : public FolderTest {
 protected:
  WhereShownTest() : store_(folder_), papers_{parse_claims(kClaims, "claims.toml")} {
    const Provenance run = fake_provenance();
    store_.begin_run(run);
    for (const char* const name : {"c", "d"}) {
      Record record = fake_record(run, "e", name);
      for (const char* const metric : {"bytes", "count", "drill_error", "time", "time_of_all", "unlike"}) {
        add(record, metric, "", {1});
      }
      store_.append(record);
    }
  }

  // Where the claim is shown, "~" before it where that shows other quantities; empty if nowhere.
  std::string place(const std::string& id, const ShownIds& shown) const {
    const auto claim = std::ranges::find(papers_[0].claims, id, &Claim::id);
    if (claim == papers_[0].claims.end()) throw std::runtime_error("no claim " + id);
    const auto found = WhereShown(papers_, shown).find(*claim, store_, "quick");
    if (!found) return "";
    return (found->same_quantity ? "" : "~") + std::string(found->layout.id);
  }

  Store store_;
  std::vector<Paper> papers_;
};

TEST_F(WhereShownTest, ATableThatNamesTheClaimComesFirstThenTablesThenPlots) {
  EXPECT_EQ(place("p.named", kAll), "p.second-table");
  EXPECT_EQ(place("p.first", kAll), "p.first-table");
  EXPECT_EQ(place("p.of-row", kAll), "p.second-table") << "the row names the metric";
  EXPECT_EQ(place("p.plotted", kAll), "p.plot");
  EXPECT_EQ(place("p.two", kAll), "p.plot") << "the claim's second number is shown, its first is not";
}

TEST_F(WhereShownTest, OtherwiseTheSameCaseWithTheMostSimilarMetric) {
  EXPECT_EQ(place("p.similar", kAll), "~p.plot") << "'time_of_all' starts like 'time'";
  EXPECT_EQ(place("p.unlike", kAll), "~p.first-table");
  EXPECT_EQ(place("p.unlike", {"p.plot"}), "~p.plot");
}

TEST_F(WhereShownTest, NothingForWhatTheReportDoesNotShow) {
  EXPECT_EQ(place("p.first", {}), "");
  EXPECT_EQ(place("p.unshown", kAll), "");
  EXPECT_EQ(place("p.unmeasured", kAll), "") << "the table has no such row";
}

// Claims that no table or plot shows read these experiments. Each checks one detail by a few numbers of one
// case, which the ledger's row gives itself. A claim that reads another experiment needs a table or plot in
// its claims.toml.
constexpr const char* kInNoTable[] = {"hybrid.sky"};

TEST(WhereShown, EveryMeasuredClaimButThoseThatCheckOneDetail) {
  const Store store = Store::open(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference");
  ShownIds all;
  std::set<std::string> in_no_table;
  for (const Paper& paper : papers()) {
    for (const TableLayout& table : paper.tables) all.insert(table.id);
    for (const PlotLayout& plot : paper.plots) all.insert(plot.id);
  }
  const WhereShown where_shown(papers(), all);
  const std::string& profile = store.profile();
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) {
      // The ledger links to the picture.
      if (std::ranges::count(claim.conditions, Condition::Kind::kFigure, &Condition::kind) > 0) continue;
      if (where_shown.find(claim, store, profile)) continue;
      for (const Condition& condition : claim.conditions) {
        for (const Operand& o : condition.operands) {
          if (store.find(o.experiment, o.case_name, profile) != nullptr) in_no_table.insert(o.experiment);
        }
      }
    }
  }
  EXPECT_THAT(in_no_table, testing::ElementsAreArray(kInNoTable));
}

}  // namespace
}  // namespace terrabench
