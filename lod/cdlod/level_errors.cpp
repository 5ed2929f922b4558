#include "lod/cdlod/level_errors.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "lod/plan_triangle.h"

namespace terrabench::cdlod {
namespace {

// Measures the triangles of one level, cell by cell.
class Ruler {
 public:
  Ruler(const GroundGrid& grid, const PatchGrid& nodes, int side, int level, bool morphs)
      : grid_(grid), nodes_(nodes), side_(side), level_(level), morphs_(morphs) {}

  // Without relief.
  const Extremes& extremes() const { return extremes_; }

  void measure(const PatchGrid::Patch& block) {
    const int step = 1 << level_;
    for (int z = block.j0; z < block.j0 + block.rows; z += step) {
      for (int x = block.i0; x < block.i0 + block.columns; x += step) measure_cell({x, z});
    }
  }

 private:
  // With every set of sides that may be joined to coarser neighbours.
  void measure_cell(glm::ivec2 low) {
    const PatchGrid::Patch patch = nodes_.patch(low.x / nodes_.side, low.y / nodes_.side);
    const MorphingNode node(grid_, side_, level_, {patch.i0, patch.j0});
    const glm::ivec2 last = glm::ivec2(grid_.width, grid_.depth) - 1, high = glm::min(low + node.step, last);
    const auto bit = [](bool set, int side) { return set ? 1U << side : 0U; };
    const unsigned sides =
        bit(low.y == node.low.y && low.y > 0, kNorth) | bit(high.x == node.high.x && high.x < last.x, kEast) |
        bit(high.y == node.high.y && high.y < last.y, kSouth) | bit(low.x == node.low.x && low.x > 0, kWest);
    for (unsigned seams = morphs_ ? sides : 0;; seams = (seams - 1) & sides) {
      measure_triangle(node, {low, {low.x, high.y}, {high.x, low.y}}, seams);
      measure_triangle(node, {{{high.x, low.y}, {low.x, high.y}, high}}, seams);
      if (seams == 0) break;
    }
  }

  void measure_triangle(const MorphingNode& node, const std::array<glm::ivec2, 3>& vertices, unsigned seams) {
    std::array<Corner, 3> sampled, upper, lower;
    bool moved = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::ivec2 at = node.place(vertices[k], seams);
      moved = moved || at != vertices[k];
      const float here = height(at.x, at.y), there = morphs_ ? node.coarser(at) : here;
      sampled[k] = {at.x, at.y, here};
      upper[k] = {at.x, at.y, std::max(here, there)};
      lower[k] = {at.x, at.y, std::min(here, there)};
    }
    if (seams != 0 && !moved) return;
    float lowest = sampled[0].y, highest = lowest;
    for_samples(upper, [&](float ground, float drawn) {
      extremes_.morphed = std::max(extremes_.morphed, drawn - ground);
      lowest = std::min(lowest, ground);
      highest = std::max(highest, ground);
    });
    extremes_.rise = std::max(extremes_.rise, highest - lowest);
    if (morphs_) {
      for_samples(lower, [&](float ground, float drawn) {
        extremes_.morphed = std::max(extremes_.morphed, ground - drawn);
      });
    }
    if (seams != 0 || level_ == 0) return;  // at the finest level all samples are vertices
    for_samples(sampled, [&](float ground, float drawn) {
      extremes_.drawn = std::max(extremes_.drawn, std::abs(drawn - ground));
    });
  }

  template <class Use>
  void for_samples(const std::array<Corner, 3>& corners, const Use& use) const {
    if (level_ == 0 && doubled_plan_area(corners.data()) == 1) {  // no samples but the corners; much faster
      for (const Corner& c : corners) use(height(c.x, c.z), c.y);
      return;
    }
    for_samples_on(corners.data(), grid_.width, grid_.depth,
                   [&](int x, int z, float y) { use(height(x, z), y); });
  }
  float height(int x, int z) const { return grid_.heights[static_cast<std::size_t>(z) * grid_.width + x]; }

  const GroundGrid& grid_;
  const PatchGrid& nodes_;
  int side_, level_;
  bool morphs_;
  Extremes extremes_;
};

float relief_of(const NodeTree& tree, int level) {
  float relief = 0;
  for (int z = 0; z < tree.grid(level).down(); ++z) {
    for (int x = 0; x < tree.grid(level).across(); ++x) relief = std::max(relief, tree.relief(level, x, z));
  }
  return relief;
}

}  // namespace

LevelErrors::LevelErrors(const GroundGrid& grid, const NodeTree& tree, int side, Progress& progress)
    : side_(side), levels_(static_cast<std::size_t>(tree.levels())) {
  constexpr int kBlock = 64;
  std::size_t blocks = 0, rows = 0;
  for (int level = 0; level < tree.levels(); ++level) {
    grids_.push_back({grid.width, grid.depth, std::max(kBlock, 2 << level)});
    firsts_.push_back(blocks);
    blocks += grids_.back().count();
    rows += static_cast<std::size_t>(grids_.back().down());
  }
  blocks_.resize(blocks);
  progress.begin("measuring levels", rows);
  measure(grid, tree, {{0, 0}, {grid.width - 1, grid.depth - 1}}, &progress);
  progress.end();
}

void LevelErrors::measure(const GroundGrid& grid, const NodeTree& tree, const SampleRect& rect,
                          Progress* progress) {
  for (int level = 0; level < tree.levels(); ++level) {
    const auto l = static_cast<std::size_t>(level);
    const PatchGrid& blocks = grids_[l];
    const PatchGrid::PatchRect some = blocks.holding(rect.low, rect.high);
    Extremes* const of_level = &blocks_[firsts_[l]];
    tbb::parallel_for(some.z0, some.z1 + 1, [&](int z) {
      for (int x = some.x0; x <= some.x1; ++x) {
        const PatchGrid::Patch block = blocks.patch(x, z);
        Ruler ruler(grid, tree.grid(level), side_, level, level + 1 < tree.levels());
        ruler.measure(block);
        of_level[static_cast<std::size_t>(z) * blocks.across() + static_cast<std::size_t>(x)] =
            ruler.extremes();
      }
      if (progress != nullptr) progress->advance();
    });
    levels_[l] = {};
    for (std::size_t k = 0; k < blocks.count(); ++k) levels_[l].add(of_level[k]);
    levels_[l].relief = relief_of(tree, level);
  }
}

}  // namespace terrabench::cdlod
