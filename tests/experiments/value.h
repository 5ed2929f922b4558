// What a test measures and reads from the record.
#pragma once

#include <gtest/gtest.h>

#include "experiments/experiment.h"
#include "results/store/record.h"
#include "results/store/statistics.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {

// The record of one case, whose pictures are thrown away.
inline Record measured_case(std::string_view id, const Case& at) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "figures");
  Record record;
  Recorder recorder(record, folder.path());
  Progress progress;
  experiment(id).measure(at, {}, recorder, progress);
  return record;
}
// Of the given parameters, and the experiment's own for the others.
inline Record measured(std::string_view id,
                       std::initializer_list<std::pair<std::string_view, Value>> given = {},
                       std::string_view terrain = "") {
  return measured_case(id, {"tiny", {experiment(id).parameters, given}, std::string(terrain)});
}

// The median of a metric's samples; -1, and a failure, where it was not measured.
inline double value(const Record& record, std::string_view metric) {
  const Metric* const found = record.find(metric);
  EXPECT_NE(found, nullptr) << metric;
  return found == nullptr ? -1 : summarise(found->samples).median;
}

}  // namespace terrabench
