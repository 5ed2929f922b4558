#include "representations/drill/pits.h"

#include <cstdint>
#include <vector>

#include "terrain/hydrology/flow.h"

namespace terrabench {
namespace {

class PitSearch {
 public:
  explicit PitSearch(const Heightfield& field) : field_(field), seen_(field.heights.size()) {}

  Pits run() {
    for (std::size_t i = 0; i < field_.heights.size(); ++i) {
      if (seen_[i] != 0 || Heightfield::is_no_data(field_.heights[i]) || flood(i)) continue;
      ++pits_.count;
      pits_.pixels += flat_.size();
    }
    return pits_;
  }

 private:
  // Collects the flat around a pixel. Returns whether water leaves it.
  bool flood(std::size_t start) {
    bool drained = false;
    flat_.assign(1, start);
    seen_[start] = 1;
    for (std::size_t next = 0; next < flat_.size(); ++next) drained |= visit(flat_[next]);
    return drained;
  }

  bool visit(std::size_t pixel) {
    bool drained = false;
    const auto width = static_cast<std::size_t>(field_.width);
    const int x = static_cast<int>(pixel % width), z = static_cast<int>(pixel / width);
    const float height = field_.heights[pixel];
    for (const FlowStep step : kFlowSteps) {
      const int i = x + step.x, j = z + step.z;
      if (i < 0 || j < 0 || i >= field_.width || j >= field_.depth) {
        drained = true;
        continue;
      }
      const float there = field_.at(i, j);
      // True for no-data too.
      if (!(there >= height)) drained = true;
      const std::size_t at = static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i);
      if (there == height && seen_[at] == 0) {
        seen_[at] = 1;
        flat_.push_back(at);
      }
    }
    return drained;
  }

  const Heightfield& field_;
  std::vector<std::uint8_t> seen_;
  std::vector<std::size_t> flat_;
  Pits pits_;
};

}  // namespace

Pits count_pits(const Heightfield& field) { return PitSearch(field).run(); }

}  // namespace terrabench
