#include "lod/geomipmap/patch_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "terrain/memory.h"

namespace terrabench {

PatchTree::PatchTree(const GroundGrid& grid, const PatchGrid& cut)
    : cut_(cut), cell_x_(grid.cell_x), cell_z_(grid.cell_z) {
  std::size_t quads = 0;
  for (int across = cut.across(), down = cut.down();; across = (across + 1) / 2, down = (down + 1) / 2) {
    layers_.push_back({across, down, quads});
    quads += static_cast<std::size_t>(across) * down;
    if (across == 1 && down == 1) break;
  }
  quads_.resize(quads);
  places_.reserve(cut.count());
  number(static_cast<int>(layers_.size()) - 1, 0, 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes_.low[axis].resize(cut_.count());
    boxes_.high[axis].resize(cut_.count());
  }
  measure(grid, cut_.all());
}

PatchTree::Quad& PatchTree::quad(int layer, int at_x, int at_z) {
  const Layer& here = layers_[static_cast<std::size_t>(layer)];
  return quads_[here.first + static_cast<std::size_t>(at_z) * here.across + at_x];
}

void PatchTree::number(int layer, int at_x, int at_z) {
  const auto next = [&] { return static_cast<std::uint32_t>(places_.size()); };
  const std::uint32_t first = next();
  if (layer == 0) {
    const PatchGrid::Patch patch = cut_.patch(at_x, at_z);
    const auto width = static_cast<std::uint32_t>(cut_.width);
    places_.push_back({cut_.slot(at_x, at_z),
                       static_cast<std::uint32_t>(patch.j0) * width + static_cast<std::uint32_t>(patch.i0),
                       cut_.shape(patch)});
  } else {
    const Layer& finer = layers_[static_cast<std::size_t>(layer - 1)];
    for (int z = 2 * at_z; z < std::min(2 * at_z + 2, finer.down); ++z) {
      for (int x = 2 * at_x; x < std::min(2 * at_x + 2, finer.across); ++x) number(layer - 1, x, z);
    }
  }
  quad(layer, at_x, at_z).patches = {first, next()};
}

void PatchTree::measure_patch(const GroundGrid& grid, int at_x, int at_z) {
  const PatchGrid::Patch patch = cut_.patch(at_x, at_z);
  Quad& leaf = quad(0, at_x, at_z);
  leaf.lowest = leaf.highest = grid.heights[static_cast<std::size_t>(patch.j0) * grid.width + patch.i0];
  for (int j = patch.j0; j <= patch.j0 + patch.rows; ++j) {
    const float* const row = &grid.heights[static_cast<std::size_t>(j) * grid.width + patch.i0];
    const auto [low, high] = std::minmax_element(row, row + patch.columns + 1);
    leaf.lowest = std::min(leaf.lowest, *low);
    leaf.highest = std::max(leaf.highest, *high);
  }
  const Bounds bounds = box(0, at_x, at_z);
  for (int axis = 0; axis < 3; ++axis) {
    boxes_.low[static_cast<std::size_t>(axis)][leaf.patches.first] = bounds.low[axis];
    boxes_.high[static_cast<std::size_t>(axis)][leaf.patches.first] = bounds.high[axis];
  }
}

void PatchTree::measure(const GroundGrid& grid, const PatchGrid::PatchRect& patches) {
  tbb::parallel_for(patches.z0, patches.z1 + 1, [&](int z) {
    for (int x = patches.x0; x <= patches.x1; ++x) measure_patch(grid, x, z);
  });
  for (int layer = 1; layer < static_cast<int>(layers_.size()); ++layer) {
    for (int z = patches.z0 >> layer; z <= patches.z1 >> layer; ++z) {
      for (int x = patches.x0 >> layer; x <= patches.x1 >> layer; ++x) {
        Quad& all = quad(layer, x, z);
        const auto low = boxes_.low[1].begin(), high = boxes_.high[1].begin();
        all.lowest = *std::min_element(low + all.patches.first, low + all.patches.last);
        all.highest = *std::max_element(high + all.patches.first, high + all.patches.last);
      }
    }
  }
}

Bounds PatchTree::box(int layer, int at_x, int at_z) const {
  const Layer& here = layers_[static_cast<std::size_t>(layer)];
  const Quad& quad = quads_[here.first + static_cast<std::size_t>(at_z) * here.across + at_x];
  const int span = cut_.side << layer;
  const int i1 = std::min((at_x + 1) * span, cut_.width - 1),
            j1 = std::min((at_z + 1) * span, cut_.depth - 1);
  return {{static_cast<float>(at_x * span) * cell_x_, quad.lowest, static_cast<float>(at_z * span) * cell_z_},
          {static_cast<float>(i1) * cell_x_, quad.highest, static_cast<float>(j1) * cell_z_}};
}

void PatchTree::collect(const Frustum& frustum, std::vector<PatchRange>& seen) const {
  collect(static_cast<int>(layers_.size()) - 1, 0, 0, Frustum::kAllPlanes, frustum, seen);
}

void PatchTree::collect(int layer, int at_x, int at_z, unsigned planes, const Frustum& frustum,
                        std::vector<PatchRange>& seen) const {
  const Sight sight = frustum.see(box(layer, at_x, at_z), planes);
  if (sight == Sight::kOutside) return;
  if (sight == Sight::kInside || layer == 0) {
    const Layer& here = layers_[static_cast<std::size_t>(layer)];
    const PatchRange& patches =
        quads_[here.first + static_cast<std::size_t>(at_z) * here.across + at_x].patches;
    if (!seen.empty() && seen.back().last == patches.first) {
      seen.back().last = patches.last;
    } else {
      seen.push_back(patches);
    }
    return;
  }
  const Layer& finer = layers_[static_cast<std::size_t>(layer - 1)];
  for (int z = 2 * at_z; z < std::min(2 * at_z + 2, finer.down); ++z) {
    for (int x = 2 * at_x; x < std::min(2 * at_x + 2, finer.across); ++x) {
      collect(layer - 1, x, z, planes, frustum, seen);
    }
  }
}

Memory PatchTree::memory() const {
  Memory memory = index_memory(layers_, quads_, places_);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    memory += index_memory(boxes_.low[axis], boxes_.high[axis]);
  }
  return memory;
}

}  // namespace terrabench
