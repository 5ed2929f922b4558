#include "results/further_grounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "results/report_tables.h"

namespace terrabench {
namespace {

std::string_view ground_of(std::string_view case_name) { return case_name.substr(0, case_name.find('/')); }
std::string_view rest_of(std::string_view case_name) { return case_name.substr(ground_of(case_name).size()); }

// The ground of a DEM is called by the file's path; tables show the file name only.
std::string_view short_name(std::string_view ground) { return ground.substr(ground.rfind('/') + 1); }

std::set<std::string, std::less<>> named_grounds(std::span<const RankingLayout> layouts) {
  std::set<std::string, std::less<>> named;
  for (const RankingLayout& layout : layouts) {
    for (const RankingLayout::Entry& entry : layout.entries) named.emplace(ground_of(entry.case_name));
  }
  return named;
}

// The ground, if the record has the layout's metric and its case is an entry's on another ground; else empty.
std::string_view further_ground(const Record& record, const RankingLayout& layout) {
  if (record.experiment != layout.experiment || record.find(layout.metric) == nullptr) return "";
  const std::string_view name = record.case_name;
  for (const RankingLayout::Entry& entry : layout.entries) {
    const std::string_view rest = rest_of(entry.case_name);
    if (!rest.empty() && name.size() > rest.size() && name.ends_with(rest))
      return name.substr(0, name.size() - rest.size());
  }
  return "";
}

// How alike the layout's ground and another are measured: the number of metrics that the first entry measured
// on both has on both, less the number that it has on one only.
int likeness(const RankingLayout& layout, const std::string& ground, const ProfileOfStore& measured,
             const ProfileOfStore& named) {
  for (const RankingLayout::Entry& entry : layout.entries) {
    const Record* const own = named.store.find(layout.experiment, entry.case_name, named.profile);
    const Record* const other = measured.store.find(
        layout.experiment, ground + std::string(rest_of(entry.case_name)), measured.profile);
    if (own == nullptr || other == nullptr || other->find(layout.metric) == nullptr) continue;
    const auto shared = static_cast<int>(std::ranges::count_if(
        own->metrics, [&](const Metric& metric) { return other->find(metric.name) != nullptr; }));
    return 3 * shared - static_cast<int>(own->metrics.size() + other->metrics.size());
  }
  return std::numeric_limits<int>::min();
}

RankingLayout moved_to(RankingLayout layout, const std::string& ground) {
  layout.id += " on " + ground;
  layout.where = fmt::format("on {}", short_name(ground));
  for (RankingLayout::Entry& entry : layout.entries) {
    entry.case_name = ground + std::string(rest_of(entry.case_name));
  }
  return layout;
}

// Labels of the best, and of those tied with it.
std::vector<std::string> winners(const Ranking& ranking) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < std::min(ranking.tied, ranking.places.size()); ++i)
    labels.push_back(ranking.places[i].label);
  return labels;
}

bool share_a_winner(const Ranking& a, const Ranking& b) {
  const std::vector<std::string> ours = winners(a), theirs = winners(b);
  return std::ranges::any_of(ours, [&](const std::string& w) { return std::ranges::count(theirs, w) > 0; });
}

// "as on real mountains, on a fractal; on caves layered stack"
std::string beside_named(const Ranking& here, std::span<const Ranking> named) {
  std::string same, others;
  for (const Ranking& ranking : named) {
    if (ranking.layout->task != here.layout->task || !ranking.decided()) continue;
    if (here.decided() && share_a_winner(here, ranking)) {
      same += (same.empty() ? "as " : ", ") + ranking.layout->where;
    } else {
      others += fmt::format("{}{} {}", others.empty() ? "" : "; ", ranking.layout->where,
                            fmt::join(winners(ranking), ", "));
    }
  }
  if (same.empty() && others.empty()) return "nothing decided there";
  return same + (same.empty() || others.empty() ? "" : "; ") + others;
}

std::string caption(const ProfileOfStore& measured, const ProfileOfStore& named) {
  std::string text = fmt::format(
      "For each task: the best method on this ground and by which factor it is ahead of the next, with the "
      "factor's 95 % interval in brackets. The last column lists the grounds measured in {} where the task "
      "is decided: first those "
      "where the same method is best, then which method is best on the others.",
      &measured.store == &named.store ? "the same results folder"
                                      : "the results folder that was named for comparison");
  if (measured.profile != named.profile) {
    text += fmt::format(" This ground was measured in profile {}, those in profile {}.", measured.profile,
                        named.profile);
  }
  return text;
}

// `number`: of the ground, since two DEMs may have the same name.
FilledTable empty_table(std::size_t number, std::string_view ground, const std::string& caption) {
  return {{fmt::format("ground-{}-{}", number, file_name(ground)),
           fmt::format("Which method for {}", ground),
           caption,
           {{"Task"}, {"Best on this ground"}, {"On the compared grounds"}},
           {}},
          {}};
}

void add_row(const Ranking& here, std::span<const Ranking> named, FilledTable& filled) {
  const std::string& needs = here.layout->needs_text;
  filled.table.rows.push_back({{here.layout->task + (needs.empty() ? "" : ", " + needs)},
                               {here.result()},
                               {beside_named(here, named)}});
  for (const std::string& run : here.runs) {
    if (std::ranges::count(filled.runs, run) == 0) filled.runs.push_back(run);
  }
}

}  // namespace

std::vector<FurtherGround> further_grounds(std::span<const RankingLayout> layouts,
                                           const ProfileOfStore& measured, const ProfileOfStore& named) {
  const std::set<std::string, std::less<>> names = named_grounds(layouts);
  std::vector<FurtherGround> further;
  for (const Record& record : measured.store.records()) {
    if (record.profile != measured.profile) continue;
    for (const RankingLayout& layout : layouts) {
      const std::string_view ground = further_ground(record, layout);
      if (ground.empty() || names.contains(ground)) continue;
      if (std::ranges::count(further, ground, &FurtherGround::name) == 0)
        further.push_back({std::string(ground), {}});
    }
  }
  for (FurtherGround& ground : further) {
    const auto like = [&](const RankingLayout& l) { return likeness(l, ground.name, measured, named); };
    for (auto first = layouts.begin(); first != layouts.end();) {
      const auto last =
          std::find_if(first, layouts.end(), [&](const auto& l) { return l.task != first->task; });
      ground.layouts.push_back(moved_to(*std::ranges::max_element(first, last, {}, like), ground.name));
      first = last;
    }
  }
  return further;
}

std::vector<FilledTable> tables_of_further_grounds(std::span<const RankingLayout> layouts,
                                                   const ProfileOfStore& measured,
                                                   const ProfileOfStore& named) {
  const std::vector<FurtherGround> further = further_grounds(layouts, measured, named);
  const std::vector<Ranking> compared = rank(layouts, named.store, named.profile);
  std::vector<FilledTable> tables;
  for (const FurtherGround& ground : further) {
    FilledTable filled = empty_table(tables.size() + 1, short_name(ground.name), caption(measured, named));
    for (const Ranking& here : rank(ground.layouts, measured.store, measured.profile))
      add_row(here, compared, filled);
    if (!filled.table.rows.empty()) tables.push_back(std::move(filled));
  }
  return tables;
}

}  // namespace terrabench
