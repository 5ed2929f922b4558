#include "experiments/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {

namespace {

// The metric with one more sample.
Metric& with_sample(std::string_view name, std::string_view unit, double sample, Record& record) {
  if (!std::isfinite(sample)) {
    throw bad_input(fmt::format("{} cannot be recorded", sample), name,
                    "a measurement must be a finite number: the experiment is at fault");
  }
  const auto it = std::ranges::find(record.metrics, name, &Metric::name);
  Metric& metric = it != record.metrics.end()
                       ? *it
                       : record.metrics.emplace_back(Metric{std::string(name), std::string(unit), {}});
  metric.samples.push_back(sample);
  return metric;
}

}  // namespace

void Recorder::add(std::string_view metric, std::string_view unit, double sample) {
  with_sample(metric, unit, sample, record_);
}

void Recorder::add_varying(std::string_view metric, std::string_view unit, double sample) {
  with_sample(metric, unit, sample, record_).varies = true;
}

void Recorder::add_frame(std::string_view metric, std::string_view unit, double sample) {
  with_sample(metric, unit, sample, record_).series = true;
}

void Recorder::undefined(std::initializer_list<std::string_view> metrics, std::string_view reason) {
  for (const std::string_view metric : metrics) record_.undefined.emplace_back(metric, reason);
}

void Recorder::add_ratio(std::string_view metric, double numerator, double denominator,
                         std::string_view why_undefined) {
  if (denominator == 0) return undefined({metric}, why_undefined);
  add(metric, "", numerator / denominator);
}

FigureFile Recorder::figure(std::string_view id, std::string_view caption) {
  // Another profile, or a case with overridden parameters, draws a different picture under the same claim
  // id: it must not overwrite the first.
  const std::string variant = record_.overrides.empty() ? "" : "-" + checksum(record_.case_name).substr(0, 8);
  RecordedFigure figure{std::string(id), fmt::format("figures/{}.{}{}.webp", id, record_.profile, variant),
                        std::string(caption)};
  const std::filesystem::path path = folder_ / figure.file;
  record_.figures.push_back(std::move(figure));
  const auto note = [this, number = record_.figures.size() - 1](const FigureLayout& layout) {
    record_.figures[number].layout = layout;
  };
  return {path, note};
}

void Recorder::terrain(std::string_view name, std::string_view checksum, std::vector<std::string> notes) {
  record_.terrain = name;
  record_.terrain_checksum = checksum;
  record_.terrain_notes = std::move(notes);
}

}  // namespace terrabench
