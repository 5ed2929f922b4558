#include "results/further_grounds.h"

#include <gmock/gmock.h>

#include "results/record_json.h"
#include "results/report.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr std::string_view kLayouts = R"(
[sets]
ground = [{name = "hill", metric = "rmse"}, {name = "cave", metric = "volume_error"}]

[[ranking]]
each = ["ground"]
id = "error-{ground}"
task = "Least error"
where = "on a {ground}"
experiment = "x"
metric = "{ground.metric}"
best = "least"
entries = [{label = "drills", case = "{ground}/a/5%"}, {label = "voxels", case = "{ground}/b/5%"}]
)";

class FurtherGroundsTest : public FolderTest {
 protected:
  FurtherGroundsTest() : store_(folder_) { store_.begin_run(run_); }

  void measure(const std::string& name, double rmse, double volume_error, bool solid) {
    Record record = fake_record(run_, "x", name);
    add(record, "rmse", "", {rmse});
    add(record, "volume_error", "", {volume_error});
    if (solid) add(record, "cavities", "", {1});
    store_.append(record);
  }
  void measure_named_grounds() {
    measure("hill/a/5%", 1, 4, false);
    measure("hill/b/5%", 2, 3, false);
    measure("cave/a/5%", 1, 4, true);
    measure("cave/b/5%", 2, 3, true);
  }
  std::vector<FilledTable> tables() const { return tables(store_); }
  std::vector<FilledTable> tables(const Store& named) const {
    return tables_of_further_grounds(layouts_, {store_, "quick"}, {named, "quick"});
  }

  Provenance run_ = fake_provenance();
  Store store_;
  std::vector<RankingLayout> layouts_ = parse_rankings(kLayouts, "test.toml");
};

TEST_F(FurtherGroundsTest, NamedGroundsHaveNoTable) {
  measure_named_grounds();
  EXPECT_THAT(tables(), SizeIs(0));
}

TEST_F(FurtherGroundsTest, SaysWhoIsBestThereAndWhereElse) {
  measure_named_grounds();
  measure("/home/me/alps.tif/a/5%", 5, 1, false);
  measure("/home/me/alps.tif/b/5%", 10, 9, false);
  ASSERT_THAT(tables(), SizeIs(1));
  const Table table = tables()[0].table;
  EXPECT_EQ(table.title, "Which method for alps.tif");
  ASSERT_THAT(table.rows, SizeIs(1));
  EXPECT_EQ(table.rows[0][0].text, "Least error");
  EXPECT_EQ(table.rows[0][1].text, "drills (5), ahead of voxels (10) by a factor of 2");
  EXPECT_EQ(table.rows[0][2].text, "as on a hill; on a cave voxels");
  EXPECT_THAT(tables()[0].runs, SizeIs(1));
}

// Solids have cavities, so that the layout of the cave is more like them.
TEST_F(FurtherGroundsTest, ComparesSolidsAsSolids) {
  measure_named_grounds();
  measure("arch/a/5%", 5, 8, true);
  measure("arch/b/5%", 10, 2, true);
  ASSERT_THAT(tables(), SizeIs(1));
  EXPECT_EQ(tables()[0].table.rows[0][1].text, "voxels (2), ahead of drills (8) by a factor of 4");
  EXPECT_EQ(tables()[0].table.rows[0][2].text, "as on a cave; on a hill drills");
}

TEST_F(FurtherGroundsTest, ComparesWithTheGroundsOfAnotherFolder) {
  measure_named_grounds();
  Store mine(folder_ / "mine");
  std::swap(store_, mine);
  store_.begin_run(run_);
  measure("alps/a/5%", 5, 1, false);
  measure("alps/b/5%", 10, 9, false);
  EXPECT_EQ(tables()[0].table.rows[0][2].text, "nothing decided there");
  EXPECT_EQ(tables(mine)[0].table.rows[0][2].text, "as on a hill; on a cave voxels");
  EXPECT_THAT(tables(mine)[0].table.caption, HasSubstr("named for comparison"));
  EXPECT_THAT(tables(mine)[0].table.caption, Not(HasSubstr("profile")));
  const auto mixed = tables_of_further_grounds(layouts_, {store_, "quick"}, {mine, "paper"});
  EXPECT_THAT(mixed[0].table.caption, HasSubstr("measured in profile quick, those in profile paper"));
}

TEST_F(FurtherGroundsTest, SaysThatNothingWasMeasuredToCompare) {
  measure("alps/a/5%", 5, 1, false);
  measure("alps/b/5%", 10, 9, false);
  ASSERT_THAT(tables(), SizeIs(1));
  EXPECT_EQ(tables()[0].table.rows[0][2].text, "nothing decided there");
}

TEST_F(FurtherGroundsTest, WhatIsUndecidedIsNotTheSame) {
  measure_named_grounds();
  measure("alps/a/5%", 5, 1, false);
  run_.git_revision[0] = 'f';
  run_.id = digest(run_);
  store_.begin_run(run_);
  measure("alps/b/5%", 10, 9, false);
  ASSERT_THAT(tables(), SizeIs(1));
  EXPECT_THAT(tables()[0].table.rows[0][1].text, HasSubstr("not compared, as "));
  EXPECT_EQ(tables()[0].table.rows[0][2].text, "on a hill drills; on a cave voxels");
}

TEST_F(FurtherGroundsTest, DemsOfOneNameHaveTheirOwnTables) {
  for (const char* const folder : {"/x/", "/y/"}) {
    for (const char* const type : {"a", "b"})
      measure(std::string(folder) + "alps.tif/" + type + "/5%", 1, 1, false);
  }
  ASSERT_THAT(tables(), SizeIs(2));
  EXPECT_NE(tables()[0].table.id, tables()[1].table.id);
}

TEST_F(FurtherGroundsTest, StandInTheReport) {
  const RankingLayout& layout = ranking_layouts()[0];
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string& name = layout.entries[i].case_name;
    Record record = fake_record(run_, layout.experiment, "alps.tif" + name.substr(name.find('/')));
    add(record, layout.metric, "B", {1000.0 * static_cast<double>(i + 1)});
    store_.append(record);
  }
  const std::string page = read_file(write_report(folder_));
  EXPECT_THAT(page, HasSubstr("Which method for alps.tif"));
  EXPECT_THAT(page, HasSubstr(layout.entries[0].label + " (1 kB), ahead of"));
}

}  // namespace
}  // namespace terrabench
