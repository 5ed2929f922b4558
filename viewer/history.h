// What the frames of the last seconds cost, for plots.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

namespace terrabench::viewer {

// Of one frame of one method. Times are milliseconds, each until the renderer has finished.
struct FrameSample {
  double at = 0;  // seconds, ascending from frame to frame
  double choose = 0, send = 0, draw = 0;
  std::size_t triangles = 0;
  std::size_t bytes_sent = 0;  // to the renderer
  std::size_t memory = 0;      // held by the method, bytes
};

class History {
 public:
  static constexpr double kSeconds = 10;

  // Drops what is older than kSeconds before it. O(1) amortised.
  void add(const FrameSample&);
  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }
  const FrameSample& last() const { return samples_.back(); }
  // One value per sample, in order. O(samples)
  template <class Value>
  std::vector<float> values(const Value& of) const {
    std::vector<float> all;
    for (const FrameSample& sample : samples_) all.push_back(static_cast<float>(of(sample)));
    return all;
  }

 private:
  std::deque<FrameSample> samples_;
};

}  // namespace terrabench::viewer
