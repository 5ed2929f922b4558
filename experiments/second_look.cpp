#include "experiments/second_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "experiments/interference.h"

namespace terrabench {

std::string exact_difference(const Record& first, const Record& again) {
  if (again.outcome != CaseOutcome::kMeasured)
    return fmt::format("{}: {}", name(again.outcome), again.reason);
  for (const Metric& metric : again.metrics) {
    if (first.find(metric.name) == nullptr) return fmt::format("the new metric '{}'", metric.name);
  }
  for (const Metric& metric : first.metrics) {
    const Metric* const other = again.find(metric.name);
    if (other == nullptr) return fmt::format("the lost metric '{}'", metric.name);
    if (timed(metric)) continue;
    if (metric.unit == other->unit && metric.samples == other->samples) continue;
    return fmt::format("the metric '{}': {} {}, then {} {}", metric.name, fmt::join(metric.samples, " "),
                       metric.unit, fmt::join(other->samples, " "), other->unit);
  }
  const bool same_pictures = std::ranges::equal(first.figures, again.figures, {}, &RecordedFigure::checksum,
                                                &RecordedFigure::checksum);
  return same_pictures ? "" : "the pictures";
}

Record with_second_look(Look first, Look again) {
  if (disturbed(first.loop) && !disturbed(again.loop)) std::swap(first, again);
  if (disturbed(first.loop) == disturbed(again.loop)) {
    for (Metric& metric : first.record.metrics) {
      if (!timed(metric)) continue;
      const std::vector<double>& more = again.record.find(metric.name)->samples;
      metric.first_look = metric.samples.size();
      metric.samples.insert(metric.samples.end(), more.begin(), more.end());
    }
  }
  return std::move(first.record);
}

}  // namespace terrabench
