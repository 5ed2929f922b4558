// Whether a tree and the independent evaluation of the same events say the same within one cell: what one
// calls solid (or air), the other calls so somewhere within a cell of the place.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "terrain/events/evaluate.h"
#include "tests/representations/ght_ground.h"

namespace terrabench::test {

class Agreement {
 public:
  Agreement(const Ght& ght, std::shared_ptr<const events::Sculpture> sculpture)
      : ght_(ght), cell_(ght.model().tree.lattice().cell()), evaluation_(std::move(sculpture)) {}

  // Points of `columns` random vertical lines, half a cell apart, where they differ by more than a cell.
  std::size_t disagreements(std::size_t columns, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    const Bounds box = ght_.bounds();
    std::size_t wrong = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      const float x = box.low.x + unit(random) * box.size().x, z = box.low.z + unit(random) * box.size().z;
      wrong += disagreements_at(x, z);
    }
    return wrong;
  }

  std::size_t disagreements_at(float x, float z) {
    const SpanSink own = spans_of(ght_, {std::span(&x, 1), std::span(&z, 1)});
    gather(x, z);
    std::size_t wrong = 0;
    const Bounds box = ght_.bounds();
    for (double y = box.low.y + cell_; y < box.high.y + 2 * cell_; y += 0.5 * cell_) {
      const bool solid = std::any_of(own.all().begin(), own.all().end(),
                                     [&](const Span& s) { return s.bottom <= y && y < s.top; });
      wrong += solid ? !near_solid(y) : !near_air(y);
    }
    return wrong;
  }

 private:
  using Column = std::vector<events::Stretch>;

  void gather(float x, float z) {
    const Bounds box = ght_.bounds();
    around_.clear();
    for (int k = 0; k < 25; ++k) {
      const glm::dvec2 at{x + 0.5 * cell_ * (k % 5 - 2), z + 0.5 * cell_ * (k / 5 - 2)};
      if (at.x < box.low.x || at.y < box.low.z || at.x > box.high.x || at.y > box.high.z) continue;
      evaluation_.column(at, around_.emplace_back());
    }
  }
  bool near_solid(double y) const {
    return std::any_of(around_.begin(), around_.end(), [&](const Column& column) {
      return std::any_of(column.begin(), column.end(), [&](const events::Stretch& s) {
        return s.bottom <= y + cell_ && y - cell_ < s.top;
      });
    });
  }
  // Not when a stretch holds all of [y - cell, y + cell].
  bool near_air(double y) const {
    return std::any_of(around_.begin(), around_.end(), [&](const Column& column) {
      return std::none_of(column.begin(), column.end(), [&](const events::Stretch& s) {
        return s.bottom <= y - cell_ && y + cell_ < s.top;
      });
    });
  }

  const Ght& ght_;
  double cell_;
  events::Evaluation evaluation_;
  std::vector<Column> around_;
};

}  // namespace terrabench::test
