// What a test reads from a record.
#pragma once

#include <gtest/gtest.h>

#include "results/store/record.h"
#include "results/store/statistics.h"

namespace terrabench {

// The median of a metric's samples; -1, and a failure, where it was not measured.
inline double value(const Record& record, std::string_view metric) {
  const Metric* const found = record.find(metric);
  EXPECT_NE(found, nullptr) << metric;
  return found == nullptr ? -1 : summarise(found->samples).median;
}

}  // namespace terrabench
