#include "results/report/unclaimed_cases.h"

#include <gtest/gtest.h>

#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using UnclaimedCases = FolderTest;

std::string entries() {
  return claim_entry("p.1", R"({equal = ["e/judged/n", 1]})") +
         claim_entry("p.2", R"({figure = "p.F1", brightness = "e/compared/n"})") +
         table_entry("p.t", R"({label = "l", case = "shown"})",
                     R"({title = "Time", unit = "ms", metric = "time"}, {title = "B", metric = "bytes"})") +
         plot_entry("p.p", R"({label = "l", experiment = "e", metric = "n", cases = [[1, "plotted"]]})");
}

TEST_F(UnclaimedCases, AreThoseThatNothingElseShows) {
  const Provenance run = fake_provenance();
  Store store(folder_);
  store.begin_run(run);
  const auto measure = [&](const char* experiment, const char* name, const char* metric, const char* unit) {
    Record record = fake_record(run, experiment, name);
    record.metrics.clear();
    add(record, metric, unit, {2});
    store.append(record);
  };
  for (const char* const name : {"judged", "compared", "shown", "plotted", "mine"}) {
    measure("e", name, "time", "s");
  }
  Record drawing = fake_record(run, "e", "drawing");
  add(drawing, "time", "s", {2});
  drawing.figures.push_back({"p.F1", "figures/p.F1.png", "The picture that a claim judges"});
  store.append(drawing);
  measure("e", "picture", "peaks", "");
  measure("f", "first", "a", "px");
  measure("f", "second", "b", "");
  const std::vector<Paper> papers{paper_of(entries())};

  const std::vector<TableLayout> tables = unclaimed_cases(store, papers, {}, "quick");
  ASSERT_EQ(tables.size(), 2U);
  // As the claims file's own table shows them, without columns that none of them has.
  ASSERT_EQ(tables[0].columns.size(), 1U);
  EXPECT_EQ(tables[0].columns[0].title, "Time");
  EXPECT_EQ(tables[0].columns[0].unit, "ms");
  ASSERT_EQ(tables[0].rows.size(), 1U);
  EXPECT_EQ(tables[0].rows[0].case_name, "mine");
  // No claims file has a table of this experiment.
  ASSERT_EQ(tables[1].columns.size(), 2U);
  EXPECT_EQ(tables[1].columns[0].unit, "px");
  EXPECT_EQ(tables[1].rows.size(), 2U);

  EXPECT_TRUE(unclaimed_cases(store, papers, {}, "paper").empty());
}

}  // namespace
}  // namespace terrabench
