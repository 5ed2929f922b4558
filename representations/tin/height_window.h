// Heights of those samples that a local change has come to know, in a rectangle that grows with them.
#pragma once

#include <limits>
#include <vector>

#include "terrain/tin/triangle_scan.h"

namespace terrabench::tin {

class HeightWindow {
 public:
  static constexpr float kUnknown = std::numeric_limits<float>::infinity();

  bool knows(Sample s) const { return covers(s) && heights_[index(s)] != kUnknown; }
  // Of a covered sample.
  float& at(Sample s) { return heights_[index(s)]; }
  HeightsView view() const { return {heights_.data(), width_, low_}; }

  // Grows by half its sides at least, so that all growth together takes O(samples). Throws environment_error.
  void cover(Sample low, Sample high);

 private:
  bool covers(Sample s) const {
    return !heights_.empty() && s.i >= low_.i && s.j >= low_.j && s.i < low_.i + width_ &&
           s.j < low_.j + depth_;
  }
  std::size_t index(Sample s) const {
    return static_cast<std::size_t>(s.j - low_.j) * width_ + static_cast<std::size_t>(s.i - low_.i);
  }

  Sample low_{0, 0};
  int width_ = 0, depth_ = 0;
  std::vector<float> heights_;
};

}  // namespace terrabench::tin
