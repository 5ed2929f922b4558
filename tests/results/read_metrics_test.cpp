// Only what is read is recorded: whatever a run measures is judged, shown or ranked somewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

#include "results/claims/claims.h"
#include "results/store/glob.h"
#include "results/store/store.h"

namespace terrabench {
namespace {

// Experiments and names of metrics.
using Names = std::set<std::pair<std::string, std::string>>;

void add_claims(const Paper& paper, Names& read) {
  for (const Claim& claim : paper.claims) {
    for (const Condition& condition : claim.conditions) {
      for (const auto* const operands : {&condition.operands, &condition.brightness}) {
        for (const Operand& operand : *operands) read.emplace(operand.experiment, operand.metric);
      }
    }
  }
}

void add_layouts(const Paper& paper, Names& read) {
  for (const TableLayout& table : paper.tables) {
    for (const TableLayout::Row& row : table.rows) {
      for (const TableLayout::Column& column : table.columns) {
        read.emplace(table.experiment, for_row(column, row).metric);
      }
    }
  }
  for (const PlotLayout& plot : paper.plots) {
    for (const PlotLayout::Series& series : plot.series) {
      read.emplace(series.experiment, series.metric);
      read.emplace(series.experiment, series.x_metric);
      for (const TableLayout::Row& bar : plot.rows) {
        read.emplace(series.experiment, for_row(series.metric, bar));
      }
    }
  }
  for (const RankingLayout& ranking : paper.rankings) {
    for (const RankingLayout::Entry& entry : ranking.entries) {
      read.emplace(ranking.experiment, for_row(ranking.metric, entry));
      read.emplace(ranking.experiment, for_row(ranking.needs, entry));
    }
  }
}

// Recorded although no claim, table, plot or ranking names them: "experiment metric".
constexpr const char* kOtherwiseRead[] = {
    // The report says how many columns errors leave out (results/report/further_grounds.h).
    "* columns",
    "* lost_columns",
    // [further] tells solids from heights by it (experiments/cross/claims.toml).
    "cross.representations cavities",
    // One of the reasons for which a plan skips a size; it is recorded with the others, which a table shows.
    "cross.lod-frames frame_refused",
    // The samples that the exponents in the tables are fitted through.
    "cross.scale *_columns",
    "cross.scale bytes",
    "cross.scale file",
    "cross.scale query_near",
    "cross.scale ray_near",
    "cross.scale edit_cached",
    "cross.scale uploaded",
    "cross.scale triangles",
};

TEST(ReadMetrics, WhateverIsRecordedIsRead) {
  Names read;
  for (const Paper& paper : papers()) {
    add_claims(paper, read);
    add_layouts(paper, read);
  }
  const Store store = Store::open(std::filesystem::path(TERRABENCH_SOURCE_DIR) / "results/reference");
  Names unread;
  for (const Record& record : store.records()) {
    for (const Metric& metric : record.metrics) {
      const std::string name = record.experiment + " " + metric.name;
      const bool excepted =
          std::ranges::any_of(kOtherwiseRead, [&](const char* glob) { return matches_glob(glob, name); });
      if (!excepted && !read.contains({record.experiment, metric.name})) {
        unread.emplace(record.experiment, metric.name);
      }
    }
  }
  std::string list;
  for (const auto& [experiment, metric] : unread) list += '\n' + experiment + ' ' + metric;
  EXPECT_TRUE(unread.empty()) << "no claim, table, plot or ranking reads these; they need not be "
                                 "measured:"
                              << list;
}

}  // namespace
}  // namespace terrabench
