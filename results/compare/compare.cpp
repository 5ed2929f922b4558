#include "results/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "results/store/provenance.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kNames[] = {"same",       "rose",      "fell",        "differs",
                                       "unresolved", "elsewhere", "only before", "only after"};

Change change_of(const Metric& before, const Metric& after, const Summary& ratio, bool one_machine) {
  if (before.unit != after.unit) return Change::kDiffers;
  if (!timed(before) && !timed(after))
    return before.samples == after.samples ? Change::kSame : Change::kDiffers;
  if (!one_machine) return Change::kElsewhere;
  if (!std::isfinite(ratio.median)) return Change::kUnresolved;
  constexpr Change kChanges[] = {Change::kRose, Change::kFell, Change::kSame, Change::kUnresolved};
  return kChanges[static_cast<std::size_t>(relation(ratio, true))];
}

bool same_ground(const Record& a, const Record& b) {
  return a.seed == b.seed && same_values(a.parameters, b.parameters) &&
         a.terrain_checksum == b.terrain_checksum;
}

MetricChange described(const Record& record, const Metric& metric, Change change) {
  return {record.experiment, record.case_name, record.profile, metric.name, metric.unit, change};
}

void add_only(const Record& record, const Metric& metric, Change side, Comparison& out) {
  MetricChange& change = out.metrics.emplace_back(described(record, metric, side));
  change.timed = timed(metric);
  (side == Change::kOnlyBefore ? change.before : change.after) = median(metric.samples);
}

// A case that both folders hold, with the runs that measured it.
struct Pair {
  const Record &before, &after;
  const Provenance *run_before, *run_after;  // null when unknown, a fault of the store

  bool one_machine() const {
    return run_before == nullptr || run_after == nullptr || same_machine(*run_before, *run_after);
  }
};

void add_both(const Pair& pair, const Metric& before, const Metric& after, Comparison& out) {
  const Summary ratio = summarise_ratio(after, before);
  const bool one_machine = pair.one_machine();
  MetricChange& change =
      out.metrics.emplace_back(described(pair.before, before, change_of(before, after, ratio, one_machine)));
  change.before = median(before.samples);
  change.after = median(after.samples);
  change.ratio = ratio;
  change.timed = timed(before) || timed(after);
  change.same_ground = same_ground(pair.before, pair.after);
  if (one_machine) return;
  change.machine_before = machine_name(*pair.run_before);
  change.machine_after = machine_name(*pair.run_after);
}

bool resolved(const MetricChange& m) {
  return m.timed && m.ratio.median > 0 &&
         (m.change == Change::kSame || m.change == Change::kRose || m.change == Change::kFell);
}

double median_ratio(const std::vector<MetricChange>& metrics) {
  std::vector<double> ratios;
  for (const MetricChange& m : metrics) {
    if (resolved(m)) ratios.push_back(m.ratio.median);
  }
  return ratios.empty() ? NAN : median(ratios);
}

// "paper", "paper and quick"
std::string profiles_of(const Store& store) {
  std::set<std::string> profiles;
  for (const Record& record : store.records()) profiles.insert(record.profile);
  return profiles.empty() ? "no cases" : fmt::format("{}", fmt::join(profiles, " and "));
}

// A comparison of nothing must not pass. Pictures count only for folders that hold no figures.
void demand_common(const Comparison& found, const Store& before, const Store& after) {
  const bool pictures = std::ranges::any_of(found.pictures.pictures, [](const ComparedPicture& p) {
    return p.change != PictureChange::kOnlyBefore && p.change != PictureChange::kOnlyAfter;
  });
  if (found.metrics.empty() ? pictures : !std::ranges::all_of(found.metrics, &MetricChange::one_sided)) {
    return;
  }
  const std::string left = profiles_of(before), right = profiles_of(after);
  throw bad_input(left == right
                      ? fmt::format("nothing in common: both hold profile {}, but other cases", left)
                      : fmt::format("nothing in common: {} against {}", left, right),
                  fmt::format("{} and {}", before.folder().string(), after.folder().string()),
                  "name two folders that measured the same cases in the same profile");
}

}  // namespace

bool MetricChange::one_sided() const { return change == Change::kOnlyBefore || change == Change::kOnlyAfter; }

std::string_view name(Change change) { return kNames[static_cast<std::size_t>(change)]; }

bool Comparison::exact_equal() const { return count(Change::kDiffers) == 0; }

std::size_t Comparison::count(Change change) const {
  return static_cast<std::size_t>(std::ranges::count(metrics, change, &MetricChange::change));
}

Comparison compare(const std::filesystem::path& before, const std::filesystem::path& after,
                   const PictureLimits& limits) {
  return compare(Store::open(before), Store::open(after), limits);
}

Comparison compare(const Store& before, const Store& after, const PictureLimits& limits) {
  Comparison out;
  for (const Store* const store : {&before, &after}) {
    out.warnings.insert(out.warnings.end(), store->warnings().begin(), store->warnings().end());
    out.faults.insert(out.faults.end(), store->faults().begin(), store->faults().end());
  }
  for (const Record& record : before.records()) {
    const Record* const other = after.find(record.experiment, record.case_name, record.profile);
    for (const Metric& metric : record.metrics) {
      const Metric* const match = other == nullptr ? nullptr : other->find(metric.name);
      if (match == nullptr) {
        add_only(record, metric, Change::kOnlyBefore, out);
      } else {
        add_both({record, *other, before.run(record.run), after.run(other->run)}, metric, *match, out);
      }
    }
  }
  for (const Record& record : after.records()) {
    const Record* const other = before.find(record.experiment, record.case_name, record.profile);
    for (const Metric& metric : record.metrics) {
      if (other == nullptr || other->find(metric.name) == nullptr)
        add_only(record, metric, Change::kOnlyAfter, out);
    }
  }
  out.median_ratio = median_ratio(out.metrics);
  out.pictures = compare_pictures(before, after, limits);
  demand_common(out, before, after);
  return out;
}

std::string compare_json(const Comparison& comparison) {
  Json list = Json::array();
  for (const MetricChange& m : comparison.metrics) {
    Json entry = {{"experiment", m.experiment}, {"case", m.case_name}, {"profile", m.profile},
                  {"metric", m.metric},         {"unit", m.unit},      {"change", name(m.change)}};
    if (m.change != Change::kOnlyAfter) entry["before"] = m.before;
    if (m.change != Change::kOnlyBefore) entry["after"] = m.after;
    if (!m.one_sided()) {
      // JSON has no infinity and no NaN: a ratio to zero is null.
      entry["ratio"] = m.ratio.median;
      entry["interval"] = {m.ratio.low, m.ratio.high};
      entry["timed"] = m.timed;
      entry["same_ground"] = m.same_ground;
      if (!m.machine_before.empty()) entry["machines"] = {m.machine_before, m.machine_after};
    }
    list.push_back(std::move(entry));
  }
  const Json json = {{"passed", comparison.passed()},
                     {"exact_equal", comparison.exact_equal()},
                     {"margin", kTimingMargin},
                     {"median_ratio", comparison.median_ratio},
                     {"only_before", comparison.count(Change::kOnlyBefore)},
                     {"only_after", comparison.count(Change::kOnlyAfter)},
                     {"metrics", list},
                     {"pictures", Json::parse(pictures_json(comparison.pictures))},
                     {"warnings", comparison.warnings},
                     {"faults", comparison.faults}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
