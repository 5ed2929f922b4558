#include "terrain/tin/greedy_insertion.h"

#include <tbb/parallel_for_each.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "terrain/tin/triangle_scan.h"

namespace terrabench::tin {
namespace {

// A triangle whose candidate is to be inserted.
struct Due {
  std::uint32_t place, triangle;
  auto operator<=>(const Due&) const = default;
};

// The place on a Z-order curve: the bits of both coordinates in turn.
std::uint32_t along_z_curve(Sample s) {
  const auto spread = [](std::uint32_t x) {
    x = (x | x << 8) & 0x00FF00FFU;
    x = (x | x << 4) & 0x0F0F0F0FU;
    x = (x | x << 2) & 0x33333333U;
    return (x | x << 1) & 0x55555555U;
  };
  return spread(s.i) | spread(s.j) << 1;
}

class Insertion {
 public:
  Insertion(const Heightfield& field, float largest_error, Progress& progress)
      : field_(field), progress_(progress), surface_(field.width, field.depth) {
    const HeightRange range = height_range(field);
    const float rounding = kScanRounding * std::max(std::abs(range.lowest), std::abs(range.highest));
    limit_ = std::max(0.0F, largest_error - rounding);
    has_holes_ = range.no_data > 0;
    for (const Sample corner : surface_.vertices()) heights_.push_back(height(corner));
  }

  Approximation run() {
    if (has_holes_) insert_rims();
    progress_.begin("tin", 0);
    scan(all_triangles());
    for (float pass_limit = largest_candidate(); pass_limit > limit_;) {
      pass_limit = std::max(limit_, kFall * pass_limit);
      std::vector<Due> due = due_among(all_triangles(), pass_limit);
      while (!due.empty()) {
        const std::vector<std::uint32_t> changed = insert(due);
        scan(changed);
        due = due_among(changed, pass_limit);  // the others were inserted into
        progress_.advance();
      }
    }
    progress_.end();
    Approximation result{std::move(surface_), std::move(heights_), {}};
    put_in_order(result);
    if (!has_holes_) return result;
    result.holes.reserve(candidates_.size());
    for (const Triangle& t : result.surface.triangles())
      result.holes.push_back(solid(result.surface, t) ? 0 : 1);
    return result;
  }

 private:
  static constexpr float kFall = 0.5F;      // of the limit from pass to pass
  static constexpr std::size_t kAhead = 8;  // triangles, of prefetching
  static constexpr float kListed = -1;      // the error of a triangle that waits for scan()
  static constexpr unsigned kTilesPerSide = 8;
  static constexpr std::size_t kForTiles = std::size_t{1} << 17;  // due triangles

  float height(Sample s) const { return field_.at(s.i, s.j); }
  const float* sample(Sample s) const {
    return field_.heights.data() + static_cast<std::size_t>(s.j) * field_.width + s.i;
  }

  bool hole(int i, int j) const {  // the square of samples whose north-western one is (i, j)
    return std::isnan(field_.at(i, j) + field_.at(i + 1, j) + field_.at(i, j + 1) + field_.at(i + 1, j + 1));
  }

  // No edge crosses a rim, so the square under the middle speaks for the whole triangle.
  bool solid(const Delaunay& surface, const Triangle& t) const {
    if (!has_holes_) return true;
    int i = 0, j = 0;
    for (int k = 0; k < 3; ++k) {
      i += surface.vertex(t, k).i;
      j += surface.vertex(t, k).j;
    }
    return !hole(std::min(i / 3, field_.width - 2), std::min(j / 3, field_.depth - 2));
  }

  // All samples with data that belong to a hole's square. Neighbours among them are one cell apart; no
  // lattice point lies in the circle around such an edge, so that it is in every Delaunay triangulation.
  void insert_rims() {
    std::uint32_t near = 0;
    std::vector<std::uint32_t> changed;
    for (int j = 0; j < field_.depth; ++j) {
      for (int i = 0; i < field_.width; ++i) {
        if (!on_rim(i, j)) continue;
        const Sample s{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
        near = surface_.locate(s, near);
        add(s, near, changed);
        changed.clear();
      }
    }
  }

  bool on_rim(int i, int j) const {
    if (std::isnan(field_.at(i, j))) return false;
    for (int y = std::max(0, j - 1); y <= std::min(j, field_.depth - 2); ++y) {
      for (int x = std::max(0, i - 1); x <= std::min(i, field_.width - 2); ++x) {
        if (hole(x, y)) return true;
      }
    }
    return false;
  }

  void add(Sample s, std::uint32_t triangle, std::vector<std::uint32_t>& changed) {
    const std::uint32_t vertex = surface_.insert(s, triangle, changed);
    heights_.resize(surface_.vertices().size());
    heights_[vertex] = height(s);
  }

  float largest_candidate() const {
    float largest = 0;
    for (const Candidate& c : candidates_) largest = std::max(largest, c.error);
    return largest;
  }

  std::vector<std::uint32_t> all_triangles() const {
    std::vector<std::uint32_t> all(surface_.triangles().size());
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }

  // Those of the triangles that miss more than the limit. The order follows a Z-order curve, so that
  // triangles near in space are near in memory.
  std::vector<Due> due_among(const std::vector<std::uint32_t>& triangles, float limit) const {
    std::vector<Due> due;
    for (const std::uint32_t t : triangles) {
      if (candidates_[t].error > limit) due.push_back({along_z_curve(candidates_[t].at), t});
    }
    tbb::parallel_sort(due.begin(), due.end());
    return due;
  }

  // Inserts the worst sample of each triangle that has not been changed since `due` was listed. Returns what
  // changed.
  std::vector<std::uint32_t> insert(std::vector<Due> due) {
    std::vector<std::uint32_t> changed;
    if (due.size() >= kForTiles) due = insert_by_tiles(due, changed);
    for (std::size_t k = 0; k < due.size(); ++k) {
      prefetch_for_insert(due, k);
      const std::uint32_t t = due[k].triangle;
      if (candidates_[t].error == kListed) continue;
      const std::size_t before = changed.size();
      add(candidates_[t].at, t, changed);
      candidates_.resize(surface_.triangles().size());
      list(changed, before);
    }
    return changed;
  }

  // Marks the triangles from number `first` on, and drops those that were.
  void list(std::vector<std::uint32_t>& triangles, std::size_t first) {
    std::size_t kept = first;
    for (std::size_t c = first; c < triangles.size(); ++c) {
      float& error = candidates_[triangles[c]].error;
      if (error == kListed) continue;
      error = kListed;
      triangles[kept++] = triangles[c];
    }
    triangles.resize(kept);
  }

  struct TileWork {
    Tile tile;
    std::span<const Due> due;
    Delaunay::Workspace work;
    std::vector<std::uint32_t> changed;
    std::vector<Due> left;
  };

  // All tiles at once; returns what would have changed triangles across the tiles' borders. The tiles depend
  // on the ground alone.
  std::vector<Due> insert_by_tiles(std::span<const Due> due, std::vector<std::uint32_t>& changed) {
    const auto sides = static_cast<unsigned>(std::max(field_.width, field_.depth));
    const unsigned side = std::bit_ceil(sides) / kTilesPerSide, shift = 2 * std::bit_width(side - 1);
    std::vector<TileWork> tiles;
    while (!due.empty()) {
      const std::uint32_t tile = due.front().place >> shift;
      const auto end = std::ranges::find_if(due, [&](const Due& d) { return d.place >> shift != tile; });
      const auto count = static_cast<std::size_t>(end - due.begin());
      const Sample at = candidates_[due.front().triangle].at;
      const auto corner = [&](std::uint16_t c) { return static_cast<std::uint16_t>(c / side * side); };
      tiles.push_back({{{corner(at.i), corner(at.j)}, static_cast<int>(side)},
                       due.first(count),
                       surface_.make_workspace(count),
                       {},
                       {}});
      due = due.subspan(count);
    }
    heights_.resize(surface_.vertices().size());
    candidates_.resize(surface_.triangles().size());
    tbb::parallel_for_each(tiles, [&](TileWork& work) { insert_in(work); });
    std::vector<Due> left;
    for (TileWork& work : tiles) {
      surface_.take_back(std::move(work.work));
      changed.insert(changed.end(), work.changed.begin(), work.changed.end());
      left.insert(left.end(), work.left.begin(), work.left.end());
    }
    return left;
  }

  void insert_in(TileWork& work) {
    for (std::size_t k = 0; k < work.due.size(); ++k) {
      prefetch_for_tile(work, k);
      const std::uint32_t t = work.due[k].triangle;
      const auto [error, at] = candidates_[t];
      if (error == kListed) continue;
      const std::size_t before = work.changed.size();
      const std::uint32_t vertex = surface_.insert_in(work.tile, at, t, work.work, work.changed);
      if (vertex == Delaunay::kNone) {
        work.left.push_back(work.due[k]);
        continue;
      }
      heights_[vertex] = height(at);
      list(work.changed, before);
    }
  }

  void scan(const std::vector<std::uint32_t>& triangles) {
    candidates_.resize(surface_.triangles().size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 256), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k) {
        prefetch_for_scan(triangles, k);
        candidates_[triangles[k]] = worst_of(surface_.triangles()[triangles[k]]);
      }
    });
  }

  [[gnu::always_inline]] void prefetch_for_insert(const std::vector<Due>& due, std::size_t k) const {
    if (k + 3 * kAhead >= due.size()) return;
    prefetch(&surface_.triangles()[due[k + 3 * kAhead].triangle]);
    prefetch(&candidates_[due[k + 3 * kAhead].triangle]);
    prefetch(sample(candidates_[due[k + 2 * kAhead].triangle].at));
    for (const std::uint32_t n : surface_.triangles()[due[k + 2 * kAhead].triangle].neighbour) {
      if (n == Delaunay::kNone) continue;
      prefetch(&surface_.triangles()[n]);
      prefetch(&candidates_[n]);
    }
    for (const std::uint32_t n : surface_.triangles()[due[k + kAhead].triangle].neighbour) {
      if (n == Delaunay::kNone) continue;
      const Triangle& t = surface_.triangles()[n];
      for (const std::uint32_t v : t.vertex) prefetch(&surface_.vertices()[v]);
      for (const std::uint32_t beyond : t.neighbour) {
        if (beyond != Delaunay::kNone) prefetch(&surface_.triangles()[beyond]);
      }
    }
  }

  // As the other threads change their triangles, only those are read that are wholly in the tile.
  [[gnu::always_inline]] void prefetch_for_tile(const TileWork& work, std::size_t k) const {
    if (k + 3 * kAhead >= work.due.size()) return;
    const auto due = [&](std::size_t ahead) { return work.due[k + ahead * kAhead].triangle; };
    prefetch(&surface_.triangles()[due(3)]);
    prefetch(&candidates_[due(3)]);
    prefetch(sample(candidates_[due(2)].at));
    for (const std::uint32_t v : surface_.triangles()[due(2)].vertex) prefetch(&surface_.vertices()[v]);
    const Triangle& t = surface_.triangles()[due(1)];
    if (!surface_.all_in(work.tile, t)) return;
    for (const std::uint32_t n : t.neighbour) {
      if (n == Delaunay::kNone) continue;
      prefetch(&surface_.triangles()[n]);
      prefetch(&candidates_[n]);
    }
  }

  // Waiting for memory would take most of the time. First the triangle, then its corners, then their samples.
  [[gnu::always_inline]] void prefetch_for_scan(const std::vector<std::uint32_t>& triangles,
                                                std::size_t k) const {
    if (k + 3 * kAhead >= triangles.size()) return;
    prefetch(&surface_.triangles()[triangles[k + 3 * kAhead]]);
    prefetch(&candidates_[triangles[k + 2 * kAhead]]);
    for (const std::uint32_t v : surface_.triangles()[triangles[k + 2 * kAhead]].vertex) {
      prefetch(&surface_.vertices()[v]);
      prefetch(&heights_[v]);
    }
    for (const Sample s : surface_.corners(surface_.triangles()[triangles[k + kAhead]])) {
      prefetch(sample(s));
    }
  }

  Candidate worst_of(const Triangle& t) const {
    if (!solid(surface_, t)) return {};
    return worst_sample(surface_.corners(t), corner_heights(t, heights_),
                        {field_.heights.data(), field_.width, {0, 0}});
  }

  const Heightfield& field_;
  Progress& progress_;
  Delaunay surface_;
  std::vector<float> heights_;
  std::vector<Candidate> candidates_;  // per triangle; error 0: none
  float limit_ = 0;                    // metres
  bool has_holes_ = false;
};

}  // namespace

void put_in_order(Approximation& a) {
  const auto [vertices, triangles] = a.surface.put_in_order();
  a.heights = gathered(a.heights, vertices);
  if (!a.holes.empty()) a.holes = gathered(a.holes, triangles);
}

Approximation greedy_insertion(const Heightfield& field, float largest_error, Progress& progress) {
  return Insertion(field, largest_error, progress).run();
}

}  // namespace terrabench::tin
