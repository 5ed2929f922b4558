#include "results/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <tuple>
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
  const bool has_interval = std::min(before.samples.size(), after.samples.size()) >= kFewestSamples &&
                            std::isfinite(ratio.median) && !std::isnan(ratio.low);
  if (!has_interval) return Change::kUnresolved;
  if (ratio.low > 1) return Change::kRose;
  if (ratio.high < 1) return Change::kFell;
  constexpr double kWide = 4;  // an interval around 1 that spans more does not say whether the time changed
  return ratio.high > kWide * ratio.low ? Change::kUnresolved : Change::kSame;
}

bool same_ground(const Record& a, const Record& b) {
  auto left = a.parameters, right = b.parameters;
  std::sort(left.begin(), left.end());
  std::sort(right.begin(), right.end());
  return a.seed == b.seed && left == right && a.terrain_checksum == b.terrain_checksum;
}

MetricChange described(const Record& record, const Metric& metric, Change change) {
  return {record.experiment, record.case_name, record.profile, metric.name, metric.unit, change};
}

void add_only(const Record& record, const Metric& metric, Change side, Comparison& out) {
  MetricChange& change = out.metrics.emplace_back(described(record, metric, side));
  (side == Change::kOnlyBefore ? change.before : change.after) = summarise(metric.samples).median;
}

// A case that both folders hold, with the runs that measured it.
struct Pair {
  const Record &before, &after;
  const Provenance *run_before, *run_after;  // null when unknown, a fault of the store

  bool one_machine() const {
    return run_before == nullptr || run_after == nullptr || same_machine(*run_before, *run_after);
  }
};

// Second ÷ first measurement of a case that was measured twice, if the ratio is positive and finite and
// neither median rests on too few samples.
std::optional<double> repeat_ratio(const Metric& metric) {
  const std::span<const double> samples(metric.samples);
  if (std::min(metric.first_look, samples.size() - metric.first_look) < kFewestSamples) return std::nullopt;
  const double ratio = median(samples.subspan(metric.first_look)) / median(samples.first(metric.first_look));
  return std::isfinite(ratio) && ratio > 0 ? std::optional(ratio) : std::nullopt;
}

void add_both(const Pair& pair, const Metric& before, const Metric& after, Comparison& out) {
  const Summary ratio = summarise_ratio(after.samples, before.samples);
  const bool one_machine = pair.one_machine();
  MetricChange& change =
      out.metrics.emplace_back(described(pair.before, before, change_of(before, after, ratio, one_machine)));
  change.before = summarise(before.samples).median;
  change.after = summarise(after.samples).median;
  change.ratio = ratio;
  change.timed = timed(before) || timed(after);
  change.equal = before.samples == after.samples;
  change.same_ground = same_ground(pair.before, pair.after);
  if (one_machine) {
    for (const Metric* const metric : {&before, &after}) {
      if (const auto ratio = repeat_ratio(*metric)) change.repeats.push_back(*ratio);
    }
    return;
  }
  change.machine_before = machine_name(*pair.run_before);
  change.machine_after = machine_name(*pair.run_after);
}

double log_ratio(const MetricChange& m) { return std::log(m.ratio.median); }

bool resolved(const MetricChange& m) {
  return m.timed && m.ratio.median > 0 &&
         (m.change == Change::kSame || m.change == Change::kRose || m.change == Change::kFell);
}

// Logarithms of the ratios of a group of times: after ÷ before, and second ÷ first measurement in one run.
struct Ratios {
  std::vector<double> between, within;
};

// The factor that 99 of 100 do not exceed, nor its inverse.
double spread_of(std::vector<double> logs) {
  constexpr double kShare = 0.99;
  for (double& log : logs) log = std::abs(log);
  const auto rank = logs.begin() + std::lround(std::ceil(kShare * static_cast<double>(logs.size()))) - 1;
  std::nth_element(logs.begin(), rank, logs.end());
  return std::exp(*rank);
}

// The standard deviation is estimated from the median distance to the median, so that outliers do not count:
// between the runs they may be changes of the program.
Noise noise_of(Ratios ratios) {
  constexpr double kNormal = 1.4826;  // standard deviation ÷ median distance, of a normal distribution
  constexpr double kDeviations = 3;
  auto& [between, within] = ratios;
  Noise noise{.timings = between.size(), .repeats = within.size()};
  if (between.empty()) return noise;
  const double middle = median(between);
  noise.median = std::exp(middle);
  if (noise.timings >= Noise::kLeast) {
    for (double& log : between) log = std::abs(log - middle);
    noise.deviation = std::exp(kNormal * median(between));
    noise.threshold = std::pow(noise.deviation, kDeviations);
  }
  if (noise.repeats < Noise::kRepeats) return noise;
  const double spread = spread_of(std::move(within));
  noise.by_repeats = spread > 1;  // counters may be the same each time of one run, and not in the next
  if (noise.by_repeats) noise.threshold = spread;
  return noise;
}

// Profile, experiment and metric of times, or none of all three for all times.
using Kind = std::array<std::string, 3>;

// The groups that a time belongs to, the most alike first. The last one holds all times.
std::array<Kind, 3> kinds_of(const MetricChange& m) {
  return {Kind{m.profile, m.experiment, m.metric}, Kind{m.profile, m.experiment, ""}, Kind{}};
}

// Times with the same samples in both folders, such as sizes that only long runs change, tell nothing of it.
std::map<Kind, Noise> estimate_noise(const std::vector<MetricChange>& metrics) {
  std::map<Kind, Ratios> ratios{{Kind{}, Ratios{}}};
  for (const MetricChange& m : metrics) {
    if (!resolved(m) || m.equal) continue;
    for (const Kind& kind : kinds_of(m)) {
      ratios[kind].between.push_back(log_ratio(m));
      for (const double ratio : m.repeats) ratios[kind].within.push_back(std::log(ratio));
    }
  }
  std::map<Kind, Noise> noises;
  for (auto& [kind, values] : ratios) {
    Noise noise = noise_of(std::move(values));
    if (kind != Kind{} && noise.threshold == 1) continue;  // too few, or most have one ratio
    std::tie(noise.profile, noise.experiment, noise.metric) = std::tie(kind[0], kind[1], kind[2]);
    noises[kind] = std::move(noise);
  }
  return noises;
}

Noise& noise_for(const MetricChange& m, std::map<Kind, Noise>& noises) {
  Noise* known = nullptr;
  for (const Kind& kind : kinds_of(m)) {
    const auto found = noises.find(kind);
    if (found == noises.end()) continue;
    if (kind != Kind{} && found->second.by_repeats) return found->second;
    if (known == nullptr) known = &found->second;
  }
  return *known;  // all times have an entry
}

void ignore_noise(Comparison& comparison) {
  std::map<Kind, Noise> noises = estimate_noise(comparison.metrics);
  for (MetricChange& m : comparison.metrics) {
    if (!resolved(m)) continue;
    Noise& noise = noise_for(m, noises);
    m.threshold = noise.threshold;
    ++noise.users;
    if (std::abs(log_ratio(m)) <= std::log(m.threshold)) m.change = Change::kSame;
  }
  for (const auto& [kind, noise] : noises) {
    if (kind == Kind{}) {
      comparison.noise = noise;
    } else if (noise.users > 0) {
      comparison.noises.push_back(noise);
    }
  }
}

// Leaves out each field that there were too few times to estimate.
Json json_of(const Noise& noise) {
  Json json = Json::object();
  if (!noise.experiment.empty()) {
    json["profile"] = noise.profile;
    json["experiment"] = noise.experiment;
  }
  if (!noise.metric.empty()) json["metric"] = noise.metric;
  json["timings"] = noise.timings;
  json["repeats"] = noise.repeats;
  json["users"] = noise.users;
  if (noise.timings > 0) json["median"] = noise.median;
  if (noise.timings >= Noise::kLeast) json["deviation"] = noise.deviation;
  if (noise.timings >= Noise::kLeast || noise.by_repeats) json["threshold"] = noise.threshold;
  return json;
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
  ignore_noise(out);
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
      // JSON has no infinity: a ratio to zero is null.
      entry["ratio"] = m.ratio.median;
      entry["interval"] = {m.ratio.low, m.ratio.high};
      entry["timed"] = m.timed;
      if (resolved(m)) entry["threshold"] = m.threshold;
      entry["same_ground"] = m.same_ground;
      if (!m.machine_before.empty()) entry["machines"] = {m.machine_before, m.machine_after};
    }
    list.push_back(std::move(entry));
  }
  Json noises = Json::array();
  for (const Noise& noise : comparison.noises) noises.push_back(json_of(noise));
  const Json json = {{"passed", comparison.passed()},
                     {"exact_equal", comparison.exact_equal()},
                     {"noise", json_of(comparison.noise)},
                     {"noises", noises},
                     {"only_before", comparison.count(Change::kOnlyBefore)},
                     {"only_after", comparison.count(Change::kOnlyAfter)},
                     {"metrics", list},
                     {"pictures", Json::parse(pictures_json(comparison.pictures))},
                     {"warnings", comparison.warnings},
                     {"faults", comparison.faults}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
