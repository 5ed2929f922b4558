#include "results/claims/ranking.h"

#include <fmt/format.h>

#include <algorithm>

#include "results/report/fill.h"
#include "results/store/provenance.h"

namespace terrabench {
namespace {

struct Candidate {
  const RankingLayout::Entry* entry;
  const Record* record;
  const Metric* metric;
  double to_unit;  // factor from its unit to the layout's
  double median;   // in the layout's unit
};

// Words for the first entry whose unit cannot be converted, to the layout's or to the other entries'.
std::string other_unit(const RankingLayout& layout, const RankingLayout::Entry& entry, const Metric& metric,
                       const std::vector<Candidate>& others) {
  const auto differs = [&](const std::string& unit) { return !conversion(metric.unit, unit); };
  const auto unit_of = [](const Candidate& c) { return c.metric->unit; };
  if (!differs(layout.unit) && std::ranges::none_of(others, differs, unit_of)) return "";
  return fmt::format("{} is measured in {}, which cannot be converted to {}", entry.label,
                     metric.unit.empty() ? "no unit" : metric.unit,
                     differs(layout.unit) && !layout.unit.empty() ? layout.unit : "the unit of the others");
}

bool suits(const RankingLayout& layout, const Metric& needed) {
  const double value = median(needed.samples);
  return value >= layout.needs_low && value <= layout.needs_high;
}

bool need_measured(const RankingLayout& layout, const Store& store, const std::string& profile) {
  return std::ranges::any_of(layout.entries, [&](const RankingLayout::Entry& entry) {
    const Record* const record = store.find(layout.experiment, entry.case_name, profile);
    return record != nullptr && record->find(for_row(layout.needs, entry)) != nullptr;
  });
}

// The measured entries; those that lack what is needed are noted in `left_out`, an entry in a unit that
// cannot be converted in `not_compared`.
std::vector<Candidate> candidates(const RankingLayout& layout, const Store& store, const std::string& profile,
                                  Ranking& ranking) {
  std::vector<Candidate> all;
  for (const RankingLayout::Entry& entry : layout.entries) {
    const Record* const record = store.find(layout.experiment, entry.case_name, profile);
    const Metric* const metric = record == nullptr ? nullptr : record->find(for_row(layout.metric, entry));
    if (metric == nullptr) {
      // Such as a type that does not reach the error of its case, or that cannot be edited.
      if (record != nullptr && record->outcome == CaseOutcome::kMeasured)
        ranking.left_out.push_back(entry.label);
      continue;
    }
    const std::string fault = other_unit(layout, entry, *metric, all);
    if (!fault.empty()) {
      ranking.left_out.push_back(entry.label);
      if (ranking.not_compared.empty()) ranking.not_compared = fault;
      continue;
    }
    const double to_unit = *conversion(metric->unit, layout.unit);
    all.push_back({&entry, record, metric, to_unit, to_unit * median(metric->samples)});
  }
  const auto needed_by = [&](const Candidate& c) { return c.record->find(for_row(layout.needs, *c.entry)); };
  const auto has = [&](const Candidate& c) { return needed_by(c) != nullptr; };
  if (layout.needs.empty() || std::ranges::none_of(all, has)) return all;
  std::erase_if(all, [&](const Candidate& c) {
    const Metric* const needed = needed_by(c);
    if (needed != nullptr && suits(layout, *needed)) return false;
    ranking.left_out.push_back(c.entry->label);
    return true;
  });
  return all;
}

// Why the candidates' figures cannot be compared, as words that follow "as"; empty if they can.
std::string why_not_compared(const std::vector<Candidate>& all, bool timing, const Store& store) {
  const Provenance* first = nullptr;
  for (const Candidate& c : all) {
    const Provenance* const run = store.run(c.record->run);
    if (run == nullptr) continue;  // the store reports this as a fault
    if (first == nullptr) first = run;
    if (timing && !comparable(*first, *run)) return "the times are of different machines or builds";
    if (!timing && !same_code(*first, *run)) return "the figures are of different revisions";
  }
  return "";
}

// How many times worse than the best.
Summary factor_between(const Candidate& best, const Candidate& other, bool most) {
  const Candidate &above = most ? best : other, &below = most ? other : best;
  const Summary factor = summarise_ratio(*above.metric, *below.metric, best.record == other.record);
  const bool zeros = above.median == 0 && below.median == 0;  // have no ratio
  if (&best == &other || zeros) return {factor.count, 1, 1, 1};
  const double units = above.to_unit / below.to_unit;
  return three_digits({factor.count, factor.median * units, factor.low * units, factor.high * units});
}

}  // namespace

std::span<const RankingLayout> ranking_layouts() {
  static const std::vector<RankingLayout> kLayouts = [] {
    std::vector<RankingLayout> all;
    for (const Paper& paper : papers()) all.insert(all.end(), paper.rankings.begin(), paper.rankings.end());
    return all;
  }();
  return kLayouts;
}

std::optional<Ranking> rank(const RankingLayout& layout, const Store& store, const std::string& profile) {
  Ranking ranking;
  ranking.layout = &layout;
  std::vector<Candidate> all = candidates(layout, store, profile, ranking);
  if (all.size() + ranking.left_out.size() < 2) return std::nullopt;
  // If every entry fails `needs`, the ranking says so; if `needs` was not measured either, there is none.
  if (all.empty() && !need_measured(layout, store, profile)) return std::nullopt;
  if (all.empty()) return ranking;
  std::ranges::stable_sort(all, [&](const Candidate& a, const Candidate& b) {
    return layout.most ? a.median > b.median : a.median < b.median;
  });
  const Candidate& best = all[0];
  ranking.timed = timed(*best.metric);
  ranking.margin = layout.searched ? kSearchMargin : margin_of(ranking.timed);
  if (ranking.not_compared.empty()) ranking.not_compared = why_not_compared(all, ranking.timed, store);
  if (!layout.most && best.median == 0 && all.back().median != 0 && ranking.not_compared.empty())
    ranking.not_compared = fmt::format("{} has 0, of which nothing is a multiple", best.entry->label);
  for (const Candidate& c : all) {
    ranking.places.push_back({c.entry->label, c.median, factor_between(best, c, layout.most)});
    if (std::ranges::count(ranking.runs, c.record->run) == 0) ranking.runs.push_back(c.record->run);
  }
  for (ranking.tied = 1; ranking.tied < all.size(); ++ranking.tied) {
    const Summary& factor = ranking.places[ranking.tied].factor;
    const Relation behind = relation(factor, ranking.timed, ranking.margin);
    if (behind == Relation::kMore) break;
    ranking.undecided = ranking.undecided || behind != Relation::kTied;
    ranking.too_few = ranking.too_few || (ranking.timed && factor.count < kFewestSamples);
  }
  return ranking;
}

std::vector<Ranking> rank(std::span<const RankingLayout> layouts, const Store& store,
                          const std::string& profile) {
  std::vector<Ranking> rankings;
  for (const RankingLayout& layout : layouts) {
    if (std::optional<Ranking> ranking = rank(layout, store, profile))
      rankings.push_back(std::move(*ranking));
  }
  return rankings;
}

}  // namespace terrabench
