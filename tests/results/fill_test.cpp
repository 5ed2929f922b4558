#include "results/report/fill.h"

#include <gtest/gtest.h>

#include "results/store/record_json.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

// One claims file with a plot of these series, along x in px and y in ms.
Paper with_series(const std::string& series) {
  Paper paper = paper_of(plot_entry("p.plot", series));
  paper.plots[0].x.unit = "px";
  paper.plots[0].y.unit = "ms";
  return paper;
}

class LayoutTest : public FolderTest {
 protected:
  LayoutTest() { store_.begin_run(run_); }
  Table table_of(const std::string& rows, const std::string& columns) {
    return fill(paper_of(table_entry("p.t", rows, columns)).tables.at(0), store_, judge(store_, {})).table;
  }

  Provenance run_ = fake_provenance();
  Store store_{folder_};
};

TEST_F(LayoutTest, PointsStandAtAGivenXOrAtAMetricOfTheirCase) {
  for (int i = 1; i <= 3; ++i) {
    Record record = fake_record(run_, "e", "c" + std::to_string(i));
    add(record, "time", "s", {10.0 * i});
    if (i < 3) add(record, "error", "px", {0.5 * i});
    store_.append(record);
  }
  const Paper paper = with_series(
      R"({label = "given", experiment = "e", metric = "time", cases = [[7, "c1"], [8, "c3"]]},
         {label = "measured", experiment = "e", metric = "time", x_metric = "error", cases = ["c1", "c2", "c3", "c4"]})");
  const FilledPlot filled = fill(paper.plots.at(0), store_, "quick");
  const auto& given = filled.plot.series.at(0).points;
  ASSERT_EQ(given.size(), 2U);
  EXPECT_EQ(given[0].x, 7);
  EXPECT_EQ(given[1].x, 8);
  EXPECT_EQ(given[1].y, 30'000);  // milliseconds
  // c3 has no error and c4 no record: no point.
  const auto& measured = filled.plot.series.at(1).points;
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_EQ(measured[0].x, 0.5);
  EXPECT_EQ(measured[1].x, 1);
  EXPECT_EQ(measured[1].y, 20'000);
}

TEST_F(LayoutTest, APairedSeriesHasAPointForEachSizeOfItsCase) {
  Record record = fake_record(run_, "e", "c");
  add(record, "time", "s", {4, 1, 6, 2, 5});
  add(record, "error", "px", {20, 10, 20, 10, 20});
  store_.append(record);
  const Paper paper = with_series(
      R"({label = "l", experiment = "e", metric = "time", x_metric = "error", paired = true, slope = true, cases = ["c"]})");
  const FilledPlot filled = fill(paper.plots.at(0), store_, "quick");
  const auto& points = filled.plot.series.at(0).points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].x, 10);
  EXPECT_EQ(points[0].y, 1500);
  EXPECT_EQ(points[1].x, 20);
  EXPECT_EQ(points[1].y, 5000);
  EXPECT_EQ(points[1].low, 5000) << "three samples have no interval";
  EXPECT_EQ(filled.plot.series.at(0).label, "l, slope 1.74");
}

TEST_F(LayoutTest, RowsMayNameTheMetricOfAColumn) {
  Record record = fake_record(run_, "e", "c");
  add(record, "build_slope", "", {1.5});
  add(record, "query_slope", "", {0.25});
  store_.append(record);
  const Table table = table_of(
      R"({label = "a", case = "c", cost = "build"}, {label = "b", case = "c", cost = "query"},
         {label = "d", case = "c"}, {label = "not run", case = "x", cost = "build"})",
      R"({title = "slope", metric = "<cost>_slope"})");
  ASSERT_EQ(table.rows.size(), 2U) << "rows without a metric of their case have nothing to show";
  EXPECT_EQ(table.rows[0][1].text, "1.5");
  EXPECT_EQ(table.rows[1][1].text, "0.25");
}

TEST_F(LayoutTest, StackedBarsStandInGroupsAndNeedAllTheirParts) {
  Record record = fake_record(run_, "e", "c");
  add(record, "a_choose", "s", {1, 2, 3});
  add(record, "a_draw", "s", {10});
  add(record, "b_choose", "s", {5});
  add(record, "d_choose", "s", {7});
  add(record, "d_draw", "s", {1});
  store_.append(record);
  const auto with_parts = [](const std::string& parts) {
    return paper_of(
        "[[plot]]\nid = \"p.plot\"\ntitle = \"t\"\ncaption = \"c\"\nexperiment = \"e\"\n"
        "x = {label = \"time\", unit = \"ms\"}\nparts = [" +
        parts +
        "]\n"
        "rows = [{label = \"A\", case = \"c\", group = \"low\", of = \"a\"},"
        "{label = \"B\", case = \"c\", group = \"low\", of = \"b\"},"
        "{label = \"gone\", case = \"x\", group = \"none\", of = \"a\"},"
        "{label = \"D\", case = \"c\", group = \"high\", of = \"d\"}]\n");
  };
  const Paper paper = with_parts(
      R"({label = "choosing", metric = "<of>_choose"}, {label = "drawing", metric = "<of>_draw"})");
  const FilledPlot filled = fill(paper.plots.at(0), store_, "quick");
  EXPECT_EQ(filled.plot.rows, (std::vector<std::string>{"low", "A", "high", "D"}));
  EXPECT_EQ(filled.runs.size(), 1U);
  const auto& choosing = filled.plot.series.at(0).points;
  const auto& drawing = filled.plot.series.at(1).points;
  ASSERT_EQ(choosing.size(), 2U) << "B was not drawn";
  ASSERT_EQ(drawing.size(), 2U);
  EXPECT_EQ(choosing[0].low, 0);
  EXPECT_EQ(choosing[0].x, 2000) << "the median, in ms";
  EXPECT_EQ(drawing[0].low, 2000);
  EXPECT_EQ(drawing[0].x, 12'000);
  EXPECT_EQ(drawing[0].y, 1);
  EXPECT_EQ(drawing[1].x, 8000);
  EXPECT_EQ(drawing[1].y, 3);
  EXPECT_ANY_THROW(with_parts(""));
  EXPECT_ANY_THROW(with_parts(R"({label = "choosing", metric = "m", cases = ["c"]})"));
}

TEST_F(LayoutTest, GrowthStartsAnewInEachBlockAndOnEachMachine) {
  for (int i = 1; i <= 4; ++i) {
    Record record = fake_record(run_, "e", "c" + std::to_string(i));
    add(record, "time", "s", {i == 3 ? 0.5 : 10.0 * i});
    store_.append(record);
  }
  Provenance other = run_;
  other.cpu = "another";
  other.id = digest(other);
  store_.begin_run(other);
  Record elsewhere = fake_record(other, "e", "c5");
  add(elsewhere, "time", "s", {50});
  store_.append(elsewhere);
  const Table table = table_of(R"({label = "a", case = "c1"}, {label = "b", case = "c2"},
                                  {label = "c", case = "c3", new_block = true}, {label = "d", case = "c4"},
                                  {label = "e", case = "c5"})",
                               R"({title = "growth", unit = "×", growth = "time"})");
  ASSERT_EQ(table.rows.size(), 5U);
  EXPECT_EQ(table.rows[0][1].text, "–");
  EXPECT_EQ(table.rows[1][1].text, "2");
  EXPECT_EQ(table.rows[2][1].text, "–");
  EXPECT_EQ(table.rows[3][1].text, "80");
  EXPECT_EQ(table.rows[4][1].text, "–");
}

TEST(LayoutFile, CasesWithAMeasuredXAreNamesAlone) {
  EXPECT_ANY_THROW(
      with_series(R"({label = "l", experiment = "e", metric = "m", paired = true, cases = [[1, "c"]]})"));
  EXPECT_ANY_THROW(with_series(
      R"({label = "l", experiment = "e", metric = "m", x_metric = "error", cases = [[1, "c"]]})"));
  EXPECT_ANY_THROW(with_series(R"({label = "l", experiment = "e", metric = "m", cases = ["c"]})"));
}

TEST_F(LayoutTest, ACellWithoutAValueSaysWhatTheRecordSays) {
  Record flat = fake_record(run_, "e", "flat"), failed = fake_record(run_, "e", "failed");
  add(flat, "time", "s", {1});
  flat.undefined = {{"relative", "the ground is flat"}};
  failed.outcome = CaseOutcome::kFailed;
  failed.reason = "out of memory";
  store_.append(flat);
  store_.append(failed);
  const Table table = table_of(
      R"({label = "flat", case = "flat"}, {label = "failed", case = "failed"})",
      R"({title = "a", metric = "time", unit = "s"}, {title = "b", metric = "relative"}, {title = "c", metric = "other"})");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][2].text, "not defined");
  EXPECT_EQ(table.rows[0][3].text, "–");
  EXPECT_EQ(table.rows[1][1].text, "failed");
}

}  // namespace
}  // namespace terrabench
