#include "experiments/second_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace terrabench {

std::string exact_difference(const Record& first, const Record& again) {
  for (const Metric& metric : first.metrics) {
    const Metric* const other = again.find(metric.name);
    if (other == nullptr || timed(metric)) continue;
    if (metric.unit == other->unit && metric.samples == other->samples) continue;
    return fmt::format("the metric '{}': {} {}, then {} {}", metric.name, fmt::join(metric.samples, " "),
                       metric.unit, fmt::join(other->samples, " "), other->unit);
  }
  const bool same_pictures = std::ranges::equal(first.figures, again.figures, {}, &RecordedFigure::checksum,
                                                &RecordedFigure::checksum);
  return same_pictures ? "" : "the pictures";
}

Record with_second_look(Record first, const Record& again) {
  for (Metric& metric : first.metrics) {
    const Metric* const other = again.find(metric.name);
    if (other == nullptr || !timed(metric)) continue;
    metric.samples.insert(metric.samples.end(), other->samples.begin(), other->samples.end());
  }
  for (const Metric& metric : again.metrics) {
    if (first.find(metric.name) == nullptr) first.metrics.push_back(metric);
  }
  return first;
}

}  // namespace terrabench
