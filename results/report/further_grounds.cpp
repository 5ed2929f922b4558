#include "results/report/further_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "results/report/ground_name.h"

namespace terrabench {
namespace {

// What the records say of a ground.
struct Measured {
  std::string ground;
  std::vector<const Record*> records;
};

// The experiments whose tables, plots or figures stand on pages of grounds.
std::set<std::string, std::less<>> experiments_on_pages(const Paper& paper) {
  std::set<std::string, std::less<>> experiments;
  for (const TableLayout& table : paper.tables) {
    if (!table.page.empty()) experiments.insert(table.experiment);
  }
  for (const PlotLayout& plot : paper.plots) {
    if (plot.page.empty()) continue;
    for (const PlotLayout::Series& series : plot.series) experiments.insert(series.experiment);
  }
  for (const PageLayout& page : paper.pages) {
    for (const auto* const figures : {&page.sheets, &page.pictures}) {
      for (const PageLayout::Drawn& drawn : *figures) experiments.insert(drawn.experiment);
    }
  }
  return experiments;
}

// The grounds that the paper has no page of, in the order of measurement.
std::vector<Measured> unnamed_grounds(const Paper& paper, const ProfileOfStore& measured) {
  const std::set<std::string, std::less<>> experiments = experiments_on_pages(paper);
  std::vector<Measured> grounds;
  for (const Record& record : measured.store.records()) {
    if (record.profile != measured.profile || !experiments.contains(record.experiment) ||
        !is_case_of(record, record.terrain) ||
        std::ranges::count(paper.pages, record.terrain, &PageLayout::id) > 0) {
      continue;
    }
    auto at = std::ranges::find(grounds, record.terrain, &Measured::ground);
    if (at == grounds.end()) at = grounds.insert(at, {record.terrain, {}});
    at->records.push_back(&record);
  }
  return grounds;
}

// Checksums are compared within experiments, since some measure a part of the ground.
bool has_changed(std::span<const Record* const> records) {
  std::map<std::string_view, std::string_view> checksums;  // by experiment
  return std::ranges::any_of(records, [&](const Record* record) {
    return checksums.try_emplace(record->experiment, record->terrain_checksum).first->second !=
           record->terrain_checksum;
  });
}

FurtherGround lay_out(const Paper& named, const Measured& measured, const std::string& label,
                      const ProfileOfStore& in) {
  FurtherGround ground{{measured.ground, label, ground_id(measured.ground)}, {}, {}};
  ground.paper = layouts_of(named, ground, [&](std::string_view metric) {
    return std::ranges::any_of(measured.records,
                               [&](const Record* record) { return record->find(metric) != nullptr; });
  });
  if (has_changed(measured.records)) {
    ground.warnings.emplace_back(
        "The content of this ground changed between its measurements, so that values of different cases may "
        "belong to different ground. Measure all of them again.");
  }
  std::string lost = lost_columns(in.store, in.profile, ground.name, label);
  if (!lost.empty()) ground.warnings.push_back(std::move(lost));
  return ground;
}

// Why a question has no answer there, as the records say; empty: nothing of it was measured.
std::string why_not_asked(const RankingLayout& layout, const ProfileOfStore& measured) {
  for (const RankingLayout::Entry& entry : layout.entries) {
    const Record* const record = measured.store.find(layout.experiment, entry.case_name, measured.profile);
    const auto why = record == nullptr ? std::nullopt : record->why_absent(for_row(layout.metric, entry));
    if (why) return std::string(why->reason);
  }
  return "";
}

double lost_share(const Record& record) {
  const Metric *const lost = record.find("lost_columns"), *const kept = record.find("columns");
  if (lost == nullptr || kept == nullptr || lost->samples.empty() || kept->samples.empty()) return 0;
  return lost->samples[0] / std::max(lost->samples[0] + kept->samples[0], 1.0);
}

}  // namespace

bool is_case_of(const Record& record, std::string_view ground) {
  const std::string_view name = record.case_name;
  return !ground.empty() && name.starts_with(ground) &&
         (name.size() == ground.size() || name[ground.size()] == '/');
}

std::string lost_columns(const Store& store, std::string_view profile, std::string_view ground,
                         std::string_view label) {
  constexpr double kMany = 0.01;
  const Record* most = nullptr;
  for (const Record& record : store.records()) {
    if (record.profile != profile || !record.overrides.empty() || !is_case_of(record, ground)) continue;
    if (most == nullptr || lost_share(record) > lost_share(*most)) most = &record;
  }
  if (most == nullptr || lost_share(*most) < kMany) return "";
  return fmt::format(
      "RMSE and other errors of height leave out columns where only one of ground and method has a height "
      "(beside samples without data, or in holes): up to {:.1f} % of the columns (case {}). A method that "
      "loses many columns may therefore have a smaller error. Errors of volume leave out none.",
      100 * lost_share(*most), with_label(most->case_name, most->terrain, label));
}

GroundLabels labels_of_grounds(const Store& store, std::string_view profile) {
  GroundLabels labels;
  for (const Record& record : store.records()) {
    if (record.profile == profile && !record.terrain.empty()) labels[record.terrain];
  }
  std::vector<std::string> grounds;
  for (const auto& [ground, label] : labels) grounds.push_back(ground);
  const std::vector<std::string> found = ground_labels(grounds);
  for (std::size_t k = 0; k < grounds.size(); ++k) labels[grounds[k]] = found[k];
  return labels;
}

std::string labelled(std::string text, const Record& record, const GroundLabels& labels) {
  const auto at = labels.find(record.terrain);
  return at == labels.end() ? text : with_label(std::move(text), record.terrain, at->second);
}

std::vector<FurtherGround> further_grounds(std::span<const Paper> papers, const ProfileOfStore& measured) {
  const GroundLabels labels = labels_of_grounds(measured.store, measured.profile);
  std::vector<FurtherGround> further;
  for (const Paper& paper : papers) {
    if (!paper.further) continue;
    for (const Measured& ground : unnamed_grounds(paper, measured)) {
      further.push_back(lay_out(paper, ground, labels.at(ground.ground), measured));
    }
  }
  return further;
}

std::vector<FilledTable> tables_of_further_grounds(std::span<const FurtherGround> further,
                                                   const ProfileOfStore& measured,
                                                   std::span<const Answer> elsewhere,
                                                   std::string_view purpose) {
  std::vector<FilledTable> tables;
  for (const FurtherGround& ground : further) {
    std::vector<Ranking> rankings = rank(ground.paper.rankings, measured.store, measured.profile);
    std::erase_if(rankings, [&](const Ranking& ranking) { return !matters(*ranking.layout, purpose); });
    if (rankings.empty()) continue;
    FilledTable& filled = tables.emplace_back();
    filled.table = advice(rankings, elsewhere);
    filled.table.id = ground.table_id();
    filled.table.title = "Which method for " + ground.label;
    for (const RankingLayout& layout : ground.paper.rankings) {
      const auto same = [&](const Ranking& ranking) { return ranking.layout == &layout; };
      if (!matters(layout, purpose) || std::ranges::any_of(rankings, same)) continue;
      const std::string why = why_not_asked(layout, measured);
      if (!why.empty())
        filled.table.rows.push_back({{layout.question}, {"not asked"}, {"–"}, {"–"}, {"–"}, {why}});
    }
    for (const Ranking& ranking : rankings) {
      for (const std::string& run : ranking.runs) {
        if (std::ranges::count(filled.runs, run) == 0) filled.runs.push_back(run);
      }
    }
  }
  return tables;
}

}  // namespace terrabench
