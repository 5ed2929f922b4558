// What a run leaves behind: measurements with where they came from. Verdicts, tables and plots are computed
// from these and nothing else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/plot/figure_layout.h"
#include "results/store/statistics.h"
#include "terrain/parameters.h"

namespace terrabench {

// One measured quantity with its raw samples, in the order taken; exact quantities have one sample. All
// finite.
struct Metric {
  std::string name, unit;  // unit: "s", "B", "m", "1/s", "" for counts
  std::vector<double> samples;
  // The value varies from run to run on one machine although is_timing() of its unit is false: a ratio of
  // times, a fit through times, a peak of memory, the hits of a cache.
  bool varies = false;
  // The samples are of consecutive frames of one path, of which neighbours resemble each other.
  bool series = false;
};
// Whether its samples vary from run to run of one program: by their unit, or because `varies` says so.
inline bool timed(const Metric& metric) { return metric.varies || is_timing(metric.unit); }
inline Order order_of(const Metric& metric) { return metric.series ? Order::kSeries : Order::kIndependent; }
inline Summary summarise(const Metric& metric) { return summarise(metric.samples, order_of(metric)); }
// Two series are taken to be of the same path. `in_turn`: both metrics are of one record, whose samples were.
inline Summary summarise_ratio(const Metric& numerator, const Metric& denominator, bool in_turn = false) {
  return summarise_ratio(numerator.samples, denominator.samples,
                         numerator.series && denominator.series ? Order::kSeries : Order::kIndependent,
                         in_turn);
}

// A picture that a case drew, relative to the results folder.
struct RecordedFigure {
  std::string id;             // of a claim, such as hybrid.F3
  std::string file;           // figures/hybrid.F3.png
  std::string caption;        // names the paper's figure and what is seen
  std::string checksum = "";  // of the file's bytes, so that another picture in its place is noticed
  FigureLayout layout = {};   // what it contains
};

// Where numbers came from: one per run of the program. Each record names its run.
struct Provenance {
  std::string id;  // digest of the rest
  std::string time, command, git_revision, compiler, flags, build_type, cpu, os, gl_renderer;
  bool git_dirty = true;
  int threads = 0;
  std::uint64_t memory = 0;                                    // bytes of the machine
  std::string simd;                                            // instruction set chosen at run time
  std::vector<std::pair<std::string, std::string>> libraries;  // name, version
  std::vector<std::string> timing_warnings;  // why its times are untrustworthy; older stores have none
};

// Whether times of the two runs can be compared, and a case of one need not be measured again in the other:
// same machine, code and compiler. Two builds of one revision with uncommitted changes count as the same
// code, although they may differ, so that an interrupted run can be resumed.
bool comparable(const Provenance&, const Provenance&);

// Of parameters, in any order.
using NamedValues = std::vector<std::pair<std::string, Value>>;
inline bool same_values(NamedValues a, NamedValues b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  return a == b;
}

// What became of a case. Only kMeasured has metrics and figures; the others give a reason instead.
enum class CaseOutcome {
  kMeasured,
  kFailed,   // an error stopped it: measured again by --resume
  kSkipped,  // it cannot be measured, such as a method on ground that it cannot hold
};
inline std::string_view name(CaseOutcome outcome) {
  constexpr std::string_view kNames[] = {"measured", "failed", "skipped"};
  return kNames[static_cast<std::size_t>(outcome)];
}

// Why a metric is absent: "skipped", "needs 2 × 2 samples"; or "not defined", "the ground is flat".
struct WhyAbsent {
  std::string_view word, reason;
};

// One case of one experiment.
struct Record {
  std::string experiment, case_name, profile;
  std::vector<std::string> overrides = {};  // "name=value" of --set; also in case_name, so no claim reads it
  std::string run;                          // Provenance::id
  std::uint64_t seed = 0;
  std::string terrain, terrain_checksum;        // what was measured on
  std::vector<std::string> terrain_notes = {};  // what its reader converted, guessed or left out
  std::vector<std::pair<std::string, Value>> parameters;
  std::vector<Metric> metrics;
  std::vector<RecordedFigure> figures;
  CaseOutcome outcome = CaseOutcome::kMeasured;
  std::string reason = {};  // why it was not measured; empty if it was
  double seconds = 0;       // that the case took, pictures included; 0: not known
  // Metrics that have no value, such as an error relative to a relief of 0: name, reason.
  std::vector<std::pair<std::string, std::string>> undefined = {};

  const Metric* find(std::string_view metric) const {  // null when absent
    const auto it = std::ranges::find(metrics, metric, &Metric::name);
    return it == metrics.end() ? nullptr : &*it;
  }
  // Of a metric that find() does not find; nothing when the record does not say.
  std::optional<WhyAbsent> why_absent(std::string_view metric) const {
    if (outcome != CaseOutcome::kMeasured) return WhyAbsent{name(outcome), reason};
    const auto it = std::ranges::find(undefined, metric, &std::pair<std::string, std::string>::first);
    return it == undefined.end() ? std::nullopt : std::optional(WhyAbsent{"not defined", it->second});
  }
};

}  // namespace terrabench
