#include "experiments/recorder.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrain/files.h"

namespace terrabench {

namespace {

Metric& metric_called(std::string_view name, std::string_view unit, Record& record) {
  const auto it = std::ranges::find(record.metrics, name, &Metric::name);
  if (it != record.metrics.end()) return *it;
  return record.metrics.emplace_back(Metric{std::string(name), std::string(unit), {}});
}

}  // namespace

void Recorder::add(std::string_view metric, std::string_view unit, double sample) {
  metric_called(metric, unit, record_).samples.push_back(sample);
}

void Recorder::add_varying(std::string_view metric, std::string_view unit, double sample) {
  Metric& varying = metric_called(metric, unit, record_);
  varying.varies = true;
  varying.samples.push_back(sample);
}

std::filesystem::path Recorder::figure(std::string_view id, std::string_view extension,
                                       std::string_view caption) {
  // Another profile, or a case with overridden parameters, draws a different picture under the same claim
  // id: it must not overwrite the first.
  const std::string variant = record_.overrides.empty() ? "" : "-" + checksum(record_.case_name).substr(0, 8);
  RecordedFigure figure{std::string(id),
                        fmt::format("figures/{}.{}{}.{}", id, record_.profile, variant, extension),
                        std::string(caption)};
  const std::filesystem::path path = folder_ / figure.file;
  record_.figures.push_back(std::move(figure));
  return path;
}

void Recorder::terrain(std::string_view name, std::string_view checksum) {
  record_.terrain = name;
  record_.terrain_checksum = checksum;
}

}  // namespace terrabench
