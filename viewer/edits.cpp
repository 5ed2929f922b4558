#include "viewer/edits.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace terrabench::viewer {
namespace {

// The samples of the ground in the square around the sphere; nothing if there are none.
std::optional<SampleRect> samples_under(const Heightfield& ground, const Stroke& stroke) {
  const glm::dvec2 cell(ground.cell_x, ground.cell_z), centre(stroke.centre.x, stroke.centre.z);
  const glm::dvec2 last(ground.width - 1, ground.depth - 1);
  const glm::dvec2 low = glm::max(glm::ceil((centre - stroke.radius) / cell), glm::dvec2(0));
  const glm::dvec2 high = glm::min(glm::floor((centre + stroke.radius) / cell), last);
  if (low.x > high.x || low.y > high.y) return std::nullopt;
  return SampleRect{glm::ivec2(low), glm::ivec2(high)};
}

float edited_height(float height, const Stroke& stroke, double x, double z) {
  const double away = std::hypot(x - stroke.centre.x, z - stroke.centre.z);
  if (away >= stroke.radius) return height;
  const double half = std::sqrt(stroke.radius * stroke.radius - away * away);
  const auto bottom = static_cast<float>(stroke.centre.y - half),
             top = static_cast<float>(stroke.centre.y + half);
  if (!stroke.digs) return height < top ? top : height;
  return bottom < height && height <= top ? bottom : height;
}

std::vector<float> heights_in(const Heightfield& ground, const SampleRect& rect) {
  std::vector<float> heights;
  for (int j = rect.low.y; j <= rect.high.y; ++j) {
    for (int i = rect.low.x; i <= rect.high.x; ++i) heights.push_back(ground.at(i, j));
  }
  return heights;
}

}  // namespace

std::optional<SampleRect> Edits::apply(Heightfield& ground, const Stroke& stroke) {
  const auto under = samples_under(ground, stroke);
  if (!under) return std::nullopt;
  std::vector<float> before = heights_in(ground, *under);
  SampleRect changed{under->high, under->low};
  for (int j = under->low.y; j <= under->high.y; ++j) {
    for (int i = under->low.x; i <= under->high.x; ++i) {
      float& height = ground.at(i, j);
      const float now =
          edited_height(height, stroke, static_cast<double>(i) * static_cast<double>(ground.cell_x),
                        static_cast<double>(j) * static_cast<double>(ground.cell_z));
      if (now == height) continue;
      height = now;
      changed = {glm::min(changed.low, {i, j}), glm::max(changed.high, {i, j})};
    }
  }
  if (changed.low.x > changed.high.x) return std::nullopt;
  done_.push_back({*under, std::move(before)});
  return changed;
}

SampleRect Edits::undo(Heightfield& ground) {
  const Before before = std::move(done_.back());
  done_.pop_back();
  std::size_t k = 0;
  for (int j = before.rect.low.y; j <= before.rect.high.y; ++j) {
    for (int i = before.rect.low.x; i <= before.rect.high.x; ++i) ground.at(i, j) = before.heights[k++];
  }
  return before.rect;
}

}  // namespace terrabench::viewer
