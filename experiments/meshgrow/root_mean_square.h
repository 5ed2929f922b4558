#pragma once

#include <cmath>

namespace terrabench::meshgrow {

struct RootMeanSquare {
  double sum = 0, count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double value() const { return std::sqrt(sum / count); }
};

}  // namespace terrabench::meshgrow
