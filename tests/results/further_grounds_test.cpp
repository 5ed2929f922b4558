#include "results/report/further_grounds.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "results/report/ground_name.h"
#include "results/report/report_tables.h"
#include "results/store/record_json.h"
#include "terrain/error.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr std::string_view kClaims = R"([sets]
ground = [{name = "hill", metric = "rmse"}, {name = "cave", metric = "volume_error"}]

[further]
ground = [
  {name = "{further}", label = "{further.label}", measured = "cavities", metric = "volume_error"},
  {name = "{further}", label = "{further.label}", metric = "rmse"},
]

[[page]]
each = ["ground"]
id = "{ground}"
about = "a"
sheets = ["x/{ground}/map"]

[[table]]
each = ["ground"]
id = "p.t-{ground}"
page = "{ground}"
title = "t"
caption = "c"
experiment = "x"
rows_title = "r"
rows = [{label = "a", case = "{ground}/a/5%"}]
columns = [{title = "Error", metric = "{ground.metric}"}]

[[table]]
id = "p.all"
title = "t"
caption = "c"
experiment = "x"
rows_title = "r"
rows = [{each = ["ground"], label = "a", case = "{ground}/a/5%"}]
columns = [{title = "Error", metric = "rmse"}]

[[plot]]
each = ["ground"]
id = "p.p-{ground}"
page = "{ground}"
title = "t"
caption = "c"
x = {label = "x"}
y = {label = "y"}
series = [{label = "a", experiment = "x", metric = "{ground.metric}", cases = [[1, "{ground}/a/5%"]]}]

[[ranking]]
each = ["ground"]
id = "error-{ground}"
task = "Least error"
question = "Least error?"
kind = "{ground.metric}"
purposes = ["archiving"]
where = "on a {ground}"
experiment = "x"
metric = "{ground.metric}"
best = "least"
entries = [{label = "drills", case = "{ground}/a/5%"}, {label = "voxels", case = "{ground}/b/5%"}]
)";

class FurtherGroundsTest : public FolderTest {
 protected:
  FurtherGroundsTest() : store_(folder_) { store_.begin_run(run_); }

  void measure(const std::string& ground, const std::string& rest, double rmse, double volume_error,
               bool solid) {
    Record record = fake_record(run_, "x", fmt::format("{}/{}", ground, rest));
    record.terrain = ground;
    record.terrain_checksum = checksum_;
    add(record, "rmse", "", {rmse});
    add(record, "volume_error", "", {volume_error});
    if (solid) add(record, "cavities", "", {1});
    store_.append(record);
  }
  void measure_named_grounds() {
    measure("hill", "a/5%", 1, 4, false);
    measure("hill", "b/5%", 2, 3, false);
    measure("cave", "a/5%", 1, 4, true);
    measure("cave", "b/5%", 2, 3, true);
  }
  std::vector<FurtherGround> grounds() const { return further_grounds(papers_, {store_, "quick"}); }
  std::vector<FilledTable> tables(std::string_view purpose = "") const {
    return tables_of_further_grounds(grounds(), {store_, "quick"}, answers(rank(layouts_, store_, "quick")),
                                     purpose);
  }
  // The texts of the only row of the only table.
  std::vector<std::string> row() const {
    std::vector<std::string> texts;
    for (const FilledTable& filled : tables()) {
      for (const auto& row : filled.table.rows) {
        for (const Cell& cell : row) texts.push_back(cell.text);
      }
    }
    return texts;
  }

  Provenance run_ = fake_provenance();
  std::string checksum_ = "00112233445566778899aabbccddeeff";
  Store store_;
  std::vector<Paper> papers_{paper_of(kClaims)};
  std::vector<RankingLayout> layouts_ = papers_[0].rankings;
};

TEST_F(FurtherGroundsTest, SaysWhatToTakeThereAndWhy) {
  measure_named_grounds();
  EXPECT_THAT(tables(), SizeIs(0));
  measure("/home/me/alps.tif", "a/5%", 5, 1, false);
  measure("/home/me/alps.tif", "b/5%", 10, 9, false);
  ASSERT_THAT(tables(), SizeIs(1));
  EXPECT_EQ(tables()[0].table.title, "Which method for alps.tif");
  EXPECT_THAT(
      row(), ElementsAre("Least error?", "drills", "voxels", "2 ×", "as on 1 of 1", "5 against 10 (voxels)"));
  EXPECT_THAT(tables()[0].runs, SizeIs(1));
  EXPECT_THAT(tables("archiving"), SizeIs(1));
  EXPECT_THAT(tables("flying"), SizeIs(0));
}

// Solids have cavities, which the member of [further] that compares volumes asks for.
TEST_F(FurtherGroundsTest, ComparesGroundsOfOneKind) {
  measure_named_grounds();
  measure("arch", "a/5%", 5, 8, true);
  measure("arch", "b/5%", 10, 2, true);
  EXPECT_THAT(row(),
              ElementsAre("Least error?", "voxels", "drills", "4 ×", "as on 1 of 1", "2 against 8 (drills)"))
      << "on the hill, drills are best";
}

TEST_F(FurtherGroundsTest, SayWhereTheirAnswerDiffers) {
  measure_named_grounds();
  measure("alps", "a/5%", 20, 1, false);
  measure("alps", "b/5%", 10, 1, false);
  EXPECT_EQ(row()[4], "differs: drills on 1 of 1");
}

TEST_F(FurtherGroundsTest, AreComparedOnlyWithGroundsThatWereMeasured) {
  measure("alps", "a/5%", 5, 1, false);
  measure("alps", "b/5%", 10, 9, false);
  EXPECT_EQ(row()[4], "–");
}

TEST_F(FurtherGroundsTest, WhatIsNotDecidedIsNotTheSame) {
  measure_named_grounds();
  measure("alps", "a/5%", 5, 1, false);
  run_.git_revision[0] = 'f';
  run_.id = digest(run_);
  store_.begin_run(run_);
  measure("alps", "b/5%", 10, 9, false);
  EXPECT_THAT(row(), ElementsAre("Least error?", "not decided", "–", "–", "drills on 1 of 1",
                                 "not compared, as the figures are of different revisions"));
}

// The end of a case's name does not tell where the ground's ends.
TEST_F(FurtherGroundsTest, AreKnownByTheTerrainOfTheRecord) {
  measure("/x/a/5%", "a/5%", 1, 1, false);
  measure("/x/a/5%", "b/5%", 2, 1, false);
  Record elsewhere = fake_record(run_, "x", "copy/a/5%");  // measured on other ground than its case names
  elsewhere.terrain = "/x/b";
  add(elsewhere, "rmse", "", {1});
  store_.append(elsewhere);
  Record other = fake_record(run_, "y", "alps");  // no page shows this experiment
  other.terrain = "alps";
  add(other, "rmse", "", {1});
  store_.append(other);
  ASSERT_THAT(grounds(), SizeIs(1));
  EXPECT_EQ(grounds()[0].name, "/x/a/5%");
  EXPECT_EQ(row()[5], "1 against 2 (voxels)");
}

TEST_F(FurtherGroundsTest, HaveTheLayoutsOfAPageWithTheirOwnCases) {
  measure("/x/alps.tif", "a/5%", 1, 1, false);
  ASSERT_THAT(grounds(), SizeIs(1));
  const FurtherGround ground = grounds()[0];
  EXPECT_EQ(ground.id, ground_id("/x/alps.tif"));
  EXPECT_EQ(ground.page().id, ground.id);
  EXPECT_EQ(ground.page().label, "alps.tif");
  EXPECT_THAT(ground.page().sheets, ElementsAre(PageLayout::Drawn{"x", "/x/alps.tif/map"}));
  ASSERT_THAT(ground.paper.tables, SizeIs(1));
  EXPECT_EQ(ground.paper.tables[0].id, "p.t-" + ground.id);
  EXPECT_EQ(ground.paper.tables[0].page, ground.id);
  EXPECT_EQ(ground.paper.tables[0].rows[0].case_name, "/x/alps.tif/a/5%");
  ASSERT_THAT(ground.paper.plots, SizeIs(1));
  EXPECT_EQ(ground.paper.plots[0].series[0].cases[0].second, "/x/alps.tif/a/5%");
  ASSERT_THAT(ground.paper.rankings, SizeIs(1));
  EXPECT_TRUE(ground.paper.claims.empty());
  EXPECT_THAT(ground.warnings, SizeIs(0));
}

TEST_F(FurtherGroundsTest, TellWhetherTheirContentChanged) {
  measure("alps", "a/5%", 1, 1, false);
  checksum_[0] = 'f';
  measure("arch", "a/5%", 1, 1, true);
  measure("alps", "b/5%", 1, 1, false);
  ASSERT_THAT(grounds(), SizeIs(2));
  ASSERT_THAT(grounds()[0].warnings, SizeIs(1));
  EXPECT_THAT(grounds()[0].warnings[0], HasSubstr("The content of this ground changed"));
  EXPECT_THAT(grounds()[1].warnings, SizeIs(0));
}

TEST_F(FurtherGroundsTest, RefuseAClaimsFileThatLeavesNoLayout) {
  measure("alps", "a/5%", 1, 1, false);
  const auto message = [&](std::string_view from, std::string_view to) -> std::string {
    std::string text(kClaims);
    text.replace(text.find(from), from.size(), to);
    try {
      further_grounds(std::vector{paper_of(text)}, {store_, "quick"});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("rmse", "rmse"), "");
  EXPECT_THAT(message("[further]\nground", "[further]\ngrounds"), HasSubstr("unknown set 'grounds'"));
  EXPECT_THAT(
      message("label = \"{further.label}\", metric = \"rmse\"", "measured = \"n\", metric = \"rmse\""),
      HasSubstr("no member of 'ground' suits"));
  EXPECT_THAT(message("{name = \"{further}\", label = \"{further.label}\", metric", "{name = \"x\", metric"),
              HasSubstr("one [[page]]"));
}

std::string without(std::string text, std::string_view ground) {
  const std::size_t at = text.find(ground);
  return at == text.npos ? text : text.erase(at, ground.size());
}

// What a paper shows on a ground's page, apart from its name, ids and texts.
std::multiset<std::string> shown_on(const Paper& paper, std::string_view page, std::string_view ground) {
  std::multiset<std::string> shown;
  for (const TableLayout& table : paper.tables) {
    if (table.page != page) continue;
    std::string text = table.experiment;
    for (const TableLayout::Row& row : table.rows) text += "\n" + row.label + without(row.case_name, ground);
    for (const TableLayout::Column& column : table.columns) text += "\n" + column.title + column.metric;
    shown.insert(text);
  }
  for (const PlotLayout& plot : paper.plots) {
    if (plot.page != page) continue;
    std::string text = plot.y.label + plot.y.unit;
    for (const PlotLayout::Series& series : plot.series) {
      text += "\n" + series.label + series.metric;
      for (const auto& [x, case_name] : series.cases) text += "\n" + without(case_name, ground);
    }
    shown.insert(text);
  }
  for (const PageLayout& layout : paper.pages) {
    if (layout.id != page) continue;
    for (const auto* const figures : {&layout.sheets, &layout.pictures}) {
      for (const PageLayout::Drawn& drawn : *figures)
        shown.insert(drawn.experiment + without(drawn.case_name, ground));
    }
  }
  return shown;
}

// Heights have what the real mountains have, which all experiments measure; solids what the caves have, and
// more.
TEST_F(FurtherGroundsTest, OfTheClaimsFilesHaveAllThatNamedGroundsHave) {
  for (const bool solid : {false, true}) {
    Record record = fake_record(run_, "cross.representations", solid ? "/x/arch/a" : "/x/alps/a");
    record.terrain = solid ? "/x/arch" : "/x/alps";
    add(record, solid ? "cavities" : "rmse", "", {1});
    store_.append(record);
  }
  const std::vector<FurtherGround> further = further_grounds(papers(), {store_, "quick"});
  ASSERT_THAT(further, SizeIs(2));
  const Paper& cross = *std::ranges::find(papers(), std::string("cross"), &Paper::id);
  const auto alps = shown_on(further[0].paper, further[0].id, "/x/alps");
  const auto arch = shown_on(further[1].paper, further[1].id, "/x/arch");
  EXPECT_GE(alps.size(), 20U);
  EXPECT_EQ(alps, shown_on(cross, "jacksboro", "jacksboro"));
  const auto caves = shown_on(cross, "caves", "caves");
  EXPECT_TRUE(std::ranges::includes(arch, caves));
  EXPECT_FALSE(std::ranges::includes(alps, caves)) << "their plot is of heights";
  const auto tasks = [](std::span<const RankingLayout> rankings) {
    std::vector<std::string> all;
    for (const RankingLayout& ranking : rankings) {
      if (all.empty() || all.back() != ranking.task) all.push_back(ranking.task);
    }
    return all;
  };
  for (const FurtherGround& ground : further) {
    EXPECT_EQ(tasks(ground.paper.rankings), tasks(ranking_layouts()));
    EXPECT_EQ(ground.paper.rankings.size(), tasks(ground.paper.rankings).size()) << "one per task";
  }
}

// An id names files and places on pages: no ground's may be those of another.
TEST_F(FurtherGroundsTest, HaveIdsOfTheirOwn) {
  for (const char* const ground : {"/x/alps", "/y/alps", "/x/alps-speed", "/x/caves-speed", "/x/caves"}) {
    Record record = fake_record(run_, "cross.representations", std::string(ground) + "/heightmap");
    record.terrain = ground;
    store_.append(record);
  }
  std::multiset<std::string> ids;
  const auto add_ids = [&](const Paper& paper) {
    for (const TableLayout& table : paper.tables) ids.insert(table.id);
    for (const PlotLayout& plot : paper.plots) ids.insert(plot.id);
    for (const PageLayout& page : paper.pages) ids.insert(page.id);
  };
  for (const Paper& paper : papers()) add_ids(paper);
  const std::size_t named = ids.size();
  for (const FurtherGround& ground : further_grounds(papers(), {store_, "quick"})) add_ids(ground.paper);
  EXPECT_GE(ids.size(), named + 5 * 15);
  for (const std::string& id : ids) {
    EXPECT_EQ(ids.count(id), 1U) << id;
    EXPECT_EQ(file_name(id), id);
  }
}

}  // namespace
}  // namespace terrabench
