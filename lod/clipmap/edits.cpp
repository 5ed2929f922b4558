// Edits of the ground under a clipmap: each window reads again what it holds of the edited samples.
#include <algorithm>

#include "lod/clipmap/clipmap.h"

namespace terrabench {

void Clipmap::edited(const SampleRect& rect) {
  if (source_->bounded()) {
    const glm::ivec2 first = source_->first(), samples = source_->last() - first + 1;
    check_edit({rect.low - first, rect.high - first}, samples.x, samples.y);
  }
  edits_.push_back(rect);
}

// Beyond the ground's border, the windows repeat its samples.
void Clipmap::read_edit(int l, const SampleRect& rect) {
  if (!storage_[l].filled) return;
  const glm::ivec2 corner = clip_levels_[l].corner, end = corner + pattern_.n - 1;
  glm::ivec2 low, high;
  for (const int axis : {0, 1}) {
    const bool from_border = rect.low[axis] == source_->first()[axis],
               to_border = rect.high[axis] == source_->last()[axis];
    // A level's samples lie 2^l of the ground's apart: the first at or after `low`, the last at or before
    // `high`.
    low[axis] = from_border ? corner[axis] : std::max(corner[axis], -(-rect.low[axis] >> l));
    high[axis] = to_border ? end[axis] : std::min(end[axis], rect.high[axis] >> l);
    if (low[axis] > high[axis]) return;
  }
  read_strip(l, low.x, low.y, high.x - low.x + 1, high.y - low.y + 1);
  storage_[l].tile_bounds.refresh(clip_levels_[l], low, high);
  update_blocks(l);
}

}  // namespace terrabench
