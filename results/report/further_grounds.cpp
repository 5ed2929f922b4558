#include "results/report/further_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "results/claims/toml_reader.h"
#include "results/report/ground_name.h"
#include "results/report/lost_columns.h"
#include "terrain/toml.h"

namespace terrabench {
namespace {

// What the records say of a ground.
struct Measured {
  std::string ground;
  std::vector<const Record*> records;
};

bool stands_on(const Record& record) {
  const std::string_view name = record.case_name;
  return !record.terrain.empty() && name.starts_with(record.terrain) &&
         (name.size() == record.terrain.size() || name[record.terrain.size()] == '/');
}

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
        !stands_on(record) || std::ranges::count(paper.pages, record.terrain, &PageLayout::id) > 0) {
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

// The claims file knows the ground by its id, which can stand in ids and in file names. Cases have its name.
void move_case(std::string& case_name, const FurtherGround& ground) {
  if (case_name == ground.id || case_name.starts_with(ground.id + "/"))
    case_name.replace(0, ground.id.size(), ground.name);
}

void move_figures(std::vector<PageLayout::Drawn>& figures, const FurtherGround& ground) {
  for (PageLayout::Drawn& drawn : figures) {
    if (const std::size_t at = drawn.title.find(ground.id); at != std::string::npos)
      drawn.title.replace(at, ground.id.size(), ground.label);
    move_case(drawn.case_name, ground);
  }
}

void move_cases(FurtherGround& ground) {
  for (TableLayout& table : ground.paper.tables) {
    for (TableLayout::Row& row : table.rows) move_case(row.case_name, ground);
  }
  for (PlotLayout& plot : ground.paper.plots) {
    for (PlotLayout::Series& series : plot.series) {
      for (auto& [x, case_name] : series.cases) move_case(case_name, ground);
    }
  }
  for (RankingLayout& ranking : ground.rankings) {
    for (RankingLayout::Entry& entry : ranking.entries) move_case(entry.case_name, ground);
  }
  for (PageLayout& page : ground.paper.pages) {
    page.label = ground.label;
    move_figures(page.sheets, ground);
    move_figures(page.pictures, ground);
  }
}

bool ranks_cases_of(const RankingLayout& ranking, std::string_view id) {
  return !ranking.entries.empty() &&
         std::ranges::all_of(ranking.entries, [&](const RankingLayout::Entry& entry) {
           return entry.case_name.starts_with(fmt::format("{}/", id));
         });
}

// Reads the page, tables, plots and rankings of the ground's id, with `file` as the sets are for it.
void read_layouts(const toml::table& table, const TomlFile& file, const Paper& named, FurtherGround& ground) {
  TomlTable entry({&table, &file, {}});
  Paper& paper = ground.paper;
  std::vector<PageLayout> pages = named.pages;  // tables of named grounds are read too, and left out
  for (const TomlValue& value : entry.list("page")) {
    PageLayout page = parse_page(value);
    if (page.id != ground.id) continue;
    pages.push_back(page);
    paper.pages.push_back(std::move(page));
  }
  if (paper.pages.size() != 1) entry.refuse("[further] must leave one [[page]] for a further ground");
  for (const TomlValue& value : entry.list("table")) {
    TableLayout layout = parse_table(value, pages);
    if (layout.page == ground.id) paper.tables.push_back(std::move(layout));
  }
  for (const TomlValue& value : entry.list("plot")) {
    PlotLayout layout = parse_plot(value, pages);
    if (layout.page == ground.id) paper.plots.push_back(std::move(layout));
  }
  for (const TomlValue& value : entry.list("ranking")) {
    RankingLayout layout = parse_ranking(value);
    if (ranks_cases_of(layout, ground.id)) ground.rankings.push_back(std::move(layout));
  }
}

std::vector<std::string> warnings_of(const FurtherGround& ground, std::span<const Record* const> records,
                                     const ProfileOfStore& in) {
  std::vector<std::string> warnings;
  if (has_changed(records)) {
    warnings.emplace_back(
        "The content of this ground changed between its measurements, so that values of different cases may "
        "belong to different ground. Measure all of them again.");
  }
  std::string lost = lost_columns(ground.paper, ground.page(), in.store, in.profile);
  if (!lost.empty()) warnings.push_back(std::move(lost));
  return warnings;
}

FurtherGround lay_out(const Paper& named, const Measured& measured, const std::string& label,
                      const ProfileOfStore& in) {
  FurtherGround ground{measured.ground, label, ground_id(measured.ground), {}, {}, {}};
  ground.paper.id = named.id;
  ground.paper.title = named.title;
  const ClaimsFile& claims = *named.further;
  const toml::table table = parse_toml(claims.text, claims.origin, "correct the claims file");
  TomlFile file{claims.origin, {}};
  read_sets(table, file);
  const SetMember names{{{"name", ground.id}, {"label", label}}};
  const auto has = [&](std::string_view metric) {
    return std::ranges::any_of(measured.records,
                               [&](const Record* record) { return record->find(metric) != nullptr; });
  };
  replace_sets(table, names, has, file);
  read_layouts(table, file, named, ground);
  move_cases(ground);
  ground.warnings = warnings_of(ground, measured.records, in);
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

// `compared`: whether the table has the column of the other grounds.
std::string caption(const ProfileOfStore& measured, const ProfileOfStore& named, bool compared) {
  const bool same_folder = &measured.store == &named.store;
  std::string text =
      "For each task: the best method on this ground and by which factor it is ahead of the next, with the "
      "factor's 95 % interval in brackets. " +
      tie_rule();
  if (compared) {
    text += fmt::format(
        " The last column lists the grounds measured in {} where the task is decided: first those where the "
        "same method is best or the same methods are tied, then which methods are best on the others. "
        "Its parentheses hold the factor by which the best is ahead of the next there, or within which the "
        "best are tied, with its interval.",
        same_folder ? "the same results folder" : "the results folder that was named for comparison");
  } else if (!same_folder) {
    text += " No task is decided in the results folder that was named for comparison.";
  }
  if (compared && measured.profile != named.profile) {
    text += fmt::format(" This ground was measured in profile {}, those in profile {}.", measured.profile,
                        named.profile);
  }
  return text;
}

FilledTable empty_table(const FurtherGround& ground, const ProfileOfStore& measured,
                        const ProfileOfStore& named, bool compared) {
  FilledTable filled{{ground.table_id(),
                      fmt::format("Which method for {}", ground.label),
                      caption(measured, named, compared),
                      {{"Task"}, {"Best on this ground"}},
                      {}},
                     {}};
  if (!compared) return filled;
  std::vector<Column>& columns = filled.table.columns;
  columns.push_back({"On the compared grounds"});
  if (measured.profile != named.profile) {
    columns[1].title += fmt::format(", profile {}", measured.profile);
    columns[2].title += fmt::format(", profile {}", named.profile);
  }
  return filled;
}

void add_row(const Ranking& here, std::span<const Ranking> named, bool compared, FilledTable& filled) {
  const std::string& needs = here.layout->needs_text;
  std::vector<Cell> row{{here.layout->task + (needs.empty() ? "" : ", " + needs)}, {here.result()}};
  if (compared) row.push_back({beside_named(here, named)});
  filled.table.rows.push_back(std::move(row));
  for (const std::string& run : here.runs) {
    if (std::ranges::count(filled.runs, run) == 0) filled.runs.push_back(run);
  }
}

}  // namespace

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
  const bool decided = std::ranges::any_of(elsewhere, &Ranking::decided);
  std::vector<FilledTable> tables;
  for (const FurtherGround& ground : further) {
    FilledTable filled = empty_table(ground, measured, named, decided);
    for (const Ranking& here : rank(ground.rankings, measured.store, measured.profile))
      add_row(here, elsewhere, decided, filled);
    if (!filled.table.rows.empty()) tables.push_back(std::move(filled));
  }
  return tables;
}

}  // namespace terrabench
