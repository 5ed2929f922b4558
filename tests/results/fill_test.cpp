#include "results/fill.h"

#include <gtest/gtest.h>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

// One claims file with a plot of these series.
Paper with_series(const std::string& series) {
  return parse_claims(
      "paper = \"p\"\ntitle = \"t\"\nsource = \"s\"\n"
      "[[plot]]\nid = \"p.plot\"\ntitle = \"t\"\ncaption = \"c\"\nx = {label = \"error\", unit = \"px\"}\n"
      "y = {label = \"time\", unit = \"ms\"}\n"
      "series = [" +
          series + "]\n",
      "test");
}

using LayoutTest = FolderTest;

TEST_F(LayoutTest, PointsStandAtAGivenXOrAtAMetricOfTheirCase) {
  const Provenance run = fake_provenance();
  Store store(folder_);
  store.begin_run(run);
  for (int i = 1; i <= 3; ++i) {
    Record record = fake_record(run, "e", "c" + std::to_string(i));
    add(record, "time", "s", {10.0 * i});
    if (i < 3) add(record, "error", "px", {0.5 * i});
    store.append(record);
  }
  const Paper paper = with_series(
      R"({label = "given", experiment = "e", metric = "time", cases = [[7, "c1"], [8, "c3"]]},
         {label = "measured", experiment = "e", metric = "time", x_metric = "error", cases = ["c1", "c2", "c3", "c4"]})");
  const FilledPlot filled = fill(paper.plots.at(0), store, "quick");
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

TEST(LayoutFile, CasesWithAMeasuredXAreNamesAlone) {
  EXPECT_ANY_THROW(with_series(
      R"({label = "l", experiment = "e", metric = "m", x_metric = "error", cases = [[1, "c"]]})"));
  EXPECT_ANY_THROW(with_series(R"({label = "l", experiment = "e", metric = "m", cases = ["c"]})"));
}

}  // namespace
}  // namespace terrabench
