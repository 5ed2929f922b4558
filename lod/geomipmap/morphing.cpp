#include "lod/geomipmap/morphing.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "terrain/memory.h"

namespace terrabench {
namespace {

// Rounding of a moved vertex, relative to its height.
constexpr float kHeightRounding = 0x1p-21F;
// Relative rounding of the measured errors and of the fractions.
constexpr float kSlack = 0x1p-18F;
// Least ratio of one level's error to the next finer level's. A smaller ratio would make the morph so fast
// that it looks like popping; a larger one costs triangles.
constexpr float kLeastRise = 1.25F;
// In a cut patch at level a + f, a side is at most at a + kCutSideRate · f and at a + 1: at coarser sides,
// some triangles would touch two sides. The limit starts at a, so that no side jumps when the patch reaches a
// level.
constexpr float kCutSideRate = 2;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A morph of a patch at `level`: sides in `seams` at `sides`, the others at `level`.
PatchMorph morph_of(int level, float inside, int seams, float sides) {
  PatchMorph morph{inside, {}};
  for (int s = 0; s < 4; ++s) {
    morph.sides[static_cast<std::size_t>(s)] = (seams >> s & 1) != 0 ? sides : static_cast<float>(level);
  }
  return morph;
}

// Just below `level`: the finer triangles, with all their vertices on the surface of `level`.
float nearly(int level) { return std::nextafter(static_cast<float>(level), 0.0F); }

// The sides, as bits, within whose first `count` rows of cells the triangle lies. The last row may be
// narrower.
int strips_of(const PatchRuler::Triangle& corners, const PatchGrid::Patch& patch, int level, int count) {
  const int step = 1 << level, outer = count * step;
  const auto inner = [&](int cells) { return ((cells - 1) / step + 1 - count) * step; };
  int sides = 15;
  for (const Corner& c : corners) {
    const int x = c.x - patch.i0, z = c.z - patch.j0;
    if (z > outer) sides &= ~(1 << kNorth);
    if (x < inner(patch.columns)) sides &= ~(1 << kEast);
    if (z < inner(patch.rows)) sides &= ~(1 << kSouth);
    if (x > outer) sides &= ~(1 << kWest);
  }
  return sides;
}

float mix(float a, float b, float share) { return a + (b - a) * share; }

}  // namespace

Morphing::Morphing(const GroundGrid& grid, const PatchGrid& cut, const PatchPatterns& patterns, int levels,
                   Progress& progress)
    : offsets_(cut.offsets()),
      levels_(levels),
      errors_(cut.slots() * static_cast<std::size_t>(levels), 0.0F),
      strips_(cut.slots() * static_cast<std::size_t>(levels - 1) * 4),
      rounding_(cut.slots(), 0.0F),
      allowed_(cut.slots(), 0.0F),
      level_(cut.slots(), kUnseen),
      queued_(cut.slots(), 0) {
  queue_.reserve(cut.count());
  progress.begin("measuring patches", static_cast<std::uint64_t>(cut.count()));
  measure(grid, cut, patterns, cut.all(), &progress);
  progress.end();
}

void Morphing::measure(const GroundGrid& grid, const PatchGrid& cut, const PatchPatterns& patterns,
                       const PatchGrid::PatchRect& patches, Progress* progress) {
  const tbb::blocked_range2d<int> all(patches.z0, patches.z1 + 1, patches.x0, patches.x1 + 1);
  tbb::parallel_for(all, [&](const auto& range) {
    for (int z = range.rows().begin(); z < range.rows().end(); ++z) {
      for (int x = range.cols().begin(); x < range.cols().end(); ++x) {
        const PatchGrid::Patch patch = cut.patch(x, z);
        PatchRuler ruler(grid, cut, patterns, patch);
        measure(ruler, cut.slot(x, z));
        float highest = 0;
        for (int j = patch.j0; j <= patch.j0 + patch.rows; ++j) {
          const float* const row = &grid.heights[static_cast<std::size_t>(j) * grid.width + patch.i0];
          for (int i = 0; i <= patch.columns; ++i) highest = std::max(highest, std::abs(row[i]));
        }
        rounding_[cut.slot(x, z)] = kHeightRounding * highest;
        if (progress != nullptr) progress->advance();
      }
    }
  });
}

void Morphing::measure(PatchRuler& ruler, std::uint32_t slot) {
  float* const errors = &errors_[slot * static_cast<std::size_t>(levels_)];
  const auto whole = [&](int level, int drawn_at) {
    const float at = level == drawn_at ? static_cast<float>(level) : nearly(level);
    float largest = 0;
    ruler.measure(drawn_at, 0, morph_of(drawn_at, at, 15, at),
                  [&](const auto&, float error) { largest = std::max(largest, error); });
    return largest;
  };
  for (int level = 1; level < levels_; ++level) {
    errors[level] = std::max(kLeastRise * errors[level - 1], whole(level, level));
    // In a cut patch, the morphed triangles of the finer level need not lie on this level's surface.
    if (!ruler.is_whole()) errors[level] = std::max(errors[level], whole(level, level - 1));
    measure_strips(ruler, level - 1,
                   &strips_[(slot * static_cast<std::size_t>(levels_ - 1) + (level - 1)) * 4]);
  }
}

// Triangles of a whole patch touch at most one side, so all four sides are measured at once. In a cut patch
// some touch two; each side's error is then the largest over all states of the others.
void Morphing::measure_strips(PatchRuler& ruler, int level, Strip* strips) const {
  const auto here = static_cast<float>(level);
  const PatchGrid::Patch& patch = ruler.patch();
  const auto take = [&](float Strip::*worst, int rows, int seams, int counting, const PatchMorph& morph) {
    ruler.measure(level, seams, morph, [&](const PatchRuler::Triangle& corners, float error) {
      const int sides = strips_of(corners, patch, level, rows) & counting;
      for (int s = 0; s < 4; ++s) {
        if ((sides >> s & 1) != 0) strips[s].*worst = std::max(strips[s].*worst, error);
      }
    });
  };
  std::fill_n(strips, 4, Strip{});
  take(&Strip::fine, 1, 0, 15, morph_of(level, here, 0, here));
  take(&Strip::coarse, 2, 0, 15, morph_of(level, nearly(level + 1), 15, nearly(level + 1)));
  for (int moved = ruler.is_whole() ? 15 : 1; moved < 16; ++moved) {
    // Drawn with any subset of the moved sides already reduced to the coarser level's vertices.
    for (int seams = moved; seams >= 0; seams = seams == 0 ? -1 : (seams - 1) & moved) {
      take(&Strip::side_coarse, 1, seams, moved, morph_of(level, here, moved, nearly(level + 1)));
      if (ruler.is_whole()) break;
    }
  }
  if (ruler.is_whole() && level + 2 < levels_) {
    take(&Strip::wide_side_coarse, 2, 15, 15, morph_of(level, here, 15, nearly(level + 1)));
    take(&Strip::wide_side_coarser, 2, 15, 15, morph_of(level, here, 15, nearly(level + 2)));
  }
  for (int s = 0; s < 4; ++s) {
    Strip& strip = strips[s];
    strip.side_coarse = std::max(strip.side_coarse, kLeastRise * strip.fine);
    strip.wide_side_coarse = std::max(strip.wide_side_coarse, strip.side_coarse);
    if (!ruler.is_whole()) strip.wide_side_coarser = kInfinity;
  }
}

void Morphing::choose(std::span<const PatchTree::Place> places,
                      std::span<const PatchTree::PatchRange> last_seen,
                      std::span<const PatchTree::PatchRange> seen, std::span<const float> allowed) {
  for_each_patch(last_seen, [&](std::uint32_t k) { level_[places[k].slot] = kUnseen; });
  for_each_patch(seen, [&](std::uint32_t k) {
    const std::uint32_t slot = places[k].slot;
    allowed_[slot] = (1 - kSlack) * (allowed[k] - rounding_[slot]);
    level_[slot] = own_level(slot);
  });
  for_each_patch(seen, [&](std::uint32_t k) { fit_neighbours(places[k].slot); });
  // Terminates because levels only decrease, and never below those of the neighbours that lowered them.
  while (!queue_.empty()) {
    const std::uint32_t slot = queue_.back();
    queue_.pop_back();
    queued_[slot] = 0;
    fit_neighbours(slot);
  }
}

float Morphing::own_level(std::uint32_t slot) const {
  const float allowed = allowed_[slot];
  int level = levels_ - 1;
  while (level > 0 && error(slot, level) > allowed) --level;
  if (level == levels_ - 1) return static_cast<float>(level);
  const float fine = error(slot, level), coarse = error(slot, level + 1);
  return static_cast<float>(level) + std::clamp((allowed - fine) / (coarse - fine), 0.0F, 1 - kSlack);
}

float Morphing::coarsest_side(std::uint32_t slot, int side) const {
  const float allowed = allowed_[slot];
  const int level = this->level(slot);
  const auto whole = static_cast<float>(level);
  if (level == levels_ - 1) return whole;
  const float f = level_[slot] - whole;
  const Strip& here = strip(slot, level, side);
  const float at_f = mix(here.fine, here.coarse, f), rise = here.side_coarse - here.fine;
  const bool cut = here.wide_side_coarser == kInfinity;
  float g = rise <= 0 ? 1 : f + std::max(allowed - at_f, 0.0F) / rise;
  if (cut) g = std::min(g, kCutSideRate * f);
  if (g < 1) return whole + g;
  if (cut || level + 2 == levels_) return whole + 1;
  const float at_0 = mix(here.wide_side_coarse, here.coarse, f);
  const float at_1 =
      std::max(mix(here.wide_side_coarser, strip(slot, level + 1, side).side_coarse, f), kLeastRise * at_0);
  const float beyond = at_1 <= at_0 ? 1 : std::max(allowed - at_0, 0.0F) / (at_1 - at_0);
  // At most one level coarser, rounding included.
  return std::min({whole + 1 + beyond, level_[slot] + 1, whole + 2 - kSlack});
}

void Morphing::fit_neighbours(std::uint32_t slot) {
  for (const int side : {kNorth, kEast, kSouth, kWest}) {
    const std::uint32_t neighbour =
        slot + static_cast<std::uint32_t>(offsets_[static_cast<std::size_t>(side)]);
    if (level_[neighbour] <= level_[slot]) continue;
    const float limit = std::max(coarsest_side(slot, side), level_[slot]);
    if (level_[neighbour] <= limit) continue;
    level_[neighbour] = limit;
    if (std::exchange(queued_[neighbour], 1) == 0) queue_.push_back(neighbour);
  }
}

PatchMorph Morphing::morph(std::uint32_t slot) const {
  PatchMorph morph{level_[slot], {}};
  for (std::size_t s = 0; s < 4; ++s) {
    morph.sides[s] = std::max(level_[slot], level_[slot + static_cast<std::uint32_t>(offsets_[s])]);
  }
  return morph;
}

Memory Morphing::memory() const {
  return index_memory(errors_, strips_, rounding_, allowed_, level_, queued_, queue_);
}

}  // namespace terrabench
