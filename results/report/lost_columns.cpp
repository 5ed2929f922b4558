#include "results/report/lost_columns.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/report/ground_name.h"

namespace terrabench {
namespace {

double lost_share(const Record& record) {
  const Metric *const lost = record.find("lost_columns"), *const kept = record.find("columns");
  if (lost == nullptr || kept == nullptr || lost->samples.empty() || kept->samples.empty()) return 0;
  return lost->samples[0] / std::max(lost->samples[0] + kept->samples[0], 1.0);
}

}  // namespace

std::string lost_columns(const Paper& paper, const PageLayout& page, const Store& store,
                         std::string_view profile) {
  constexpr double kMany = 0.01;
  double largest = 0;
  const Record* of = nullptr;
  const auto note = [&](std::string_view experiment, std::string_view case_name) {
    const Record* const record = store.find(experiment, case_name, profile);
    if (record == nullptr || lost_share(*record) <= largest) return;
    largest = lost_share(*record);
    of = record;
  };
  for (const TableLayout& table : paper.tables) {
    if (table.page != page.id) continue;
    for (const TableLayout::Row& row : table.rows) note(table.experiment, row.case_name);
  }
  for (const PlotLayout& plot : paper.plots) {
    if (plot.page != page.id) continue;
    for (const PlotLayout::Series& series : plot.series) {
      for (const auto& [x, case_name] : series.cases) note(series.experiment, case_name);
    }
  }
  for (const PageLayout::Drawn& sheet : page.sheets) note(sheet.experiment, sheet.case_name);
  if (of == nullptr || largest < kMany) return "";
  return fmt::format(
      "RMSE and other errors of height leave out columns where only one of ground and method has a height "
      "(beside samples without data, or in holes): up to {:.1f} % of the columns (case {}). A method that "
      "loses many columns may therefore have a smaller error. Errors of volume leave out none.",
      100 * largest, with_label(of->case_name, of->terrain, page.label));
}

}  // namespace terrabench
