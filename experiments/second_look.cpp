#include "experiments/second_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "terrain/error.h"

namespace terrabench {
namespace {

Error not_repeated(const Record& record, const std::string& what) {
  return {ExitCode::kEnvironment,
          fmt::format("measured twice in one run, the case differs in {}, which should be exact", what),
          fmt::format("{} {}", record.experiment, record.case_name),
          "report it as a bug: what is exact must not depend on what was measured before"};
}

void check_repeated(const Record& record, const Metric& first, const Metric* again) {
  if (again != nullptr && again->unit == first.unit && again->samples == first.samples) return;
  throw not_repeated(
      record, fmt::format("the metric '{}': {}, then {}", first.name, fmt::join(first.samples, " "),
                          again == nullptr ? "nothing" : fmt::format("{}", fmt::join(again->samples, " "))));
}

void check_pictures(const Record& first, const Record& again) {
  const bool equal = std::ranges::equal(first.figures, again.figures, {}, &RecordedFigure::checksum,
                                        &RecordedFigure::checksum);
  if (!equal) throw not_repeated(first, "its pictures");
}

}  // namespace

Record with_second_look(Record first, const Record& again) {
  for (Metric& metric : first.metrics) {
    const Metric* const other = again.find(metric.name);
    if (!timed(metric)) {
      check_repeated(first, metric, other);
    } else if (other != nullptr) {
      metric.samples.insert(metric.samples.end(), other->samples.begin(), other->samples.end());
    }
  }
  for (const Metric& metric : again.metrics) {
    if (first.find(metric.name) != nullptr) continue;
    if (!timed(metric))
      throw not_repeated(first, fmt::format("the metric '{}': nothing, then {}", metric.name,
                                            fmt::join(metric.samples, " ")));
    first.metrics.push_back(metric);
  }
  check_pictures(first, again);
  return first;
}

}  // namespace terrabench
