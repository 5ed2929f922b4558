#include "results/report/further_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
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

// Labels of the best, and of those tied with it.
std::vector<std::string> winners(const Ranking& ranking) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < std::min(ranking.tied, ranking.places.size()); ++i)
    labels.push_back(ranking.places[i].label);
  return labels;
}

bool same_winners(const Ranking& a, const Ranking& b) {
  std::vector<std::string> ours = winners(a), theirs = winners(b);
  std::ranges::sort(ours);
  std::ranges::sort(theirs);
  return ours == theirs;
}

// "as on real mountains (1.3 [1.2, 1.4] ×), on a fractal (2 ×); on caves drills, voxels (tied, within 1.1 ×)"
std::string beside_named(const Ranking& here, std::span<const Ranking> named) {
  std::string same, others;
  for (const Ranking& ranking : named) {
    if (ranking.layout->task != here.layout->task || !ranking.decided()) continue;
    if (here.decided() && same_winners(here, ranking)) {
      same += fmt::format("{}{} ({})", same.empty() ? "as " : ", ", ranking.layout->where, ranking.lead());
    } else {
      others += fmt::format("{}{} {} ({})", others.empty() ? "" : "; ", ranking.layout->where,
                            fmt::join(winners(ranking), ", "), ranking.lead());
    }
  }
  if (same.empty() && others.empty()) return "nothing decided there";
  return same + (same.empty() || others.empty() ? "" : "; ") + others;
}

// What the table says of its columns. `compared`: whether it has that of the other grounds.
std::string caption(bool same_folder, bool compared) {
  const std::string text =
      "For each task: the best method on this ground and by which factor it is ahead of the next, with the "
      "factor's 95 % interval in brackets. " +
      tie_rule();
  if (!compared)
    return text +
           (same_folder ? "" : " No task is decided in the results folder that was named for comparison.");
  return fmt::format(
      "{} The last column lists the grounds measured in {} where the task is decided: first those where the "
      "same method is best or the same methods are tied, then which methods are best on the others. "
      "Its parentheses hold the factor by which the best is ahead of the next there, or within which the "
      "best are tied, with its interval.",
      text, same_folder ? "the same results folder" : "the results folder that was named for comparison");
}

// `elsewhere`: rankings on the compared grounds; the table has no column of them if none is decided.
FilledTable table_of(const FurtherGround& ground, const ProfileOfStore& measured, const ProfileOfStore& named,
                     std::span<const Ranking> elsewhere) {
  const bool compared = std::ranges::any_of(elsewhere, &Ranking::decided);
  FilledTable filled{{ground.table_id(),
                      fmt::format("Which method for {}", ground.label),
                      caption(&measured.store == &named.store, compared),
                      {{"Task"}, {"Best on this ground"}},
                      {}},
                     {}};
  Table& table = filled.table;
  if (compared) table.columns.push_back({"On the compared grounds"});
  if (compared && measured.profile != named.profile) {
    table.columns[1].title += fmt::format(", profile {}", measured.profile);
    table.columns[2].title += fmt::format(", profile {}", named.profile);
  }
  for (const Ranking& here : rank(ground.paper.rankings, measured.store, measured.profile)) {
    const std::string& needs = here.layout->needs_text;
    table.rows.push_back({{here.layout->task + (needs.empty() ? "" : ", " + needs)}, {here.result()}});
    if (compared) table.rows.back().push_back({beside_named(here, elsewhere)});
    for (const std::string& run : here.runs) {
      if (std::ranges::count(filled.runs, run) == 0) filled.runs.push_back(run);
    }
  }
  return filled;
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
                                                   std::span<const RankingLayout> compared,
                                                   const ProfileOfStore& named) {
  const std::vector<Ranking> elsewhere = rank(compared, named.store, named.profile);
  std::vector<FilledTable> tables;
  for (const FurtherGround& ground : further) {
    FilledTable filled = table_of(ground, measured, named, elsewhere);
    if (!filled.table.rows.empty()) tables.push_back(std::move(filled));
  }
  return tables;
}

}  // namespace terrabench
