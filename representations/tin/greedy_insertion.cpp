#include "representations/tin/greedy_insertion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/tin/triangle_plane.h"

namespace terrabench::tin {
namespace {

// A sample of a triangle that it misses by most.
struct Candidate {
  float error = 0;
  Sample at = {0, 0};
};

// The greatest |heights[i] - (first + slope · i)|. Floats that are not negative are ordered as whole numbers,
// whose maximum compilers vectorise.
float largest_miss(const float* heights, int count, float first, float slope) {
  std::int32_t worst = 0;
  for (int i = 0; i < count; ++i) {
    const float miss = std::abs(heights[i] - (first + slope * static_cast<float>(i)));
    worst = std::max(worst, std::bit_cast<std::int32_t>(miss));
  }
  return std::bit_cast<float>(worst);
}

int first_miss(const float* heights, int count, float first, float slope, float miss) {
  for (int i = 0; i < count; ++i) {
    if (std::abs(heights[i] - (first + slope * static_cast<float>(i))) == miss) return i;
  }
  return count - 1;
}

// The columns of row j that an edge bounds. The quotients of whole numbers below 2³² are either whole or far
// enough from it that doubles round to the right side.
struct RowEnds {
  int west, east;

  RowEnds(std::array<Sample, 3> p, int j) : west(65535), east(0) {
    for (int k = 0; k < 3; ++k) {
      Sample a = p[static_cast<std::size_t>(k)], b = p[static_cast<std::size_t>((k + 1) % 3)];
      if (a.j > b.j) std::swap(a, b);
      if (j < a.j || j > b.j) continue;
      if (a.j == b.j) {
        west = std::min({west, int{a.i}, int{b.i}});
        east = std::max({east, int{a.i}, int{b.i}});
        continue;
      }
      const double at = a.i + static_cast<double>(std::int64_t{j - a.j} * (b.i - a.i)) / (b.j - a.j);
      // The interior lies to one side; the other edge of the row moves the opposite bound.
      west = std::min(west, static_cast<int>(std::ceil(at)));
      east = std::max(east, static_cast<int>(std::floor(at)));
    }
  }
};

class Insertion {
 public:
  Insertion(const Heightfield& field, float largest_error, Progress& progress)
      : field_(field), progress_(progress), surface_(field.width, field.depth) {
    const HeightRange range = height_range(field);
    // Planes are evaluated in floats here: errors of rounding count.
    const float rounding = 0x1p-21F * std::max(std::abs(range.lowest), std::abs(range.highest));
    limit_ = std::max(0.0F, largest_error - rounding);
    has_holes_ = range.no_data > 0;
    for (const Sample corner : surface_.vertices()) heights_.push_back(height(corner));
  }

  Approximation run() {
    if (has_holes_) insert_rims();
    std::vector<std::uint32_t> changed(surface_.triangles().size());
    for (std::uint32_t t = 0; t < changed.size(); ++t) changed[t] = t;
    progress_.begin("tin", 0);
    scan(changed);
    for (float pass_limit = largest_candidate(); pass_limit > limit_;) {
      pass_limit = std::max(limit_, kFall * pass_limit);
      while (insert_above(pass_limit)) progress_.advance();
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
  static constexpr float kFall = 0.5F;  // of the limit from pass to pass

  float height(Sample s) const { return field_.at(s.i, s.j); }

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
    if (vertex == heights_.size()) heights_.push_back(height(s));
  }

  float largest_candidate() const {
    float largest = 0;
    for (const Candidate& c : candidates_) largest = std::max(largest, c.error);
    return largest;
  }

  // One sample of each triangle that misses more than the limit, unless the pass changed the triangle before;
  // whether there was one.
  bool insert_above(float limit) {
    std::vector<std::uint32_t> changed;
    const std::size_t triangles = candidates_.size();
    for (std::uint32_t t = 0; t < triangles; ++t) {
      const Candidate c = candidates_[t];
      if (!(c.error > limit)) continue;
      const std::size_t first = changed.size();
      add(c.at, t, changed);
      candidates_.resize(surface_.triangles().size());
      for (std::size_t k = first; k < changed.size(); ++k) candidates_[changed[k]].error = 0;
    }
    if (changed.empty()) return false;
    std::ranges::sort(changed);
    changed.erase(std::ranges::unique(changed).begin(), changed.end());
    scan(changed);
    return true;
  }

  void scan(const std::vector<std::uint32_t>& triangles) {
    candidates_.resize(surface_.triangles().size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 256), [&](const auto& range) {
      for (std::size_t k = range.begin(); k < range.end(); ++k) {
        candidates_[triangles[k]] = worst_sample(surface_.triangles()[triangles[k]]);
      }
    });
  }

  Candidate worst_sample(const Triangle& t) const {
    Candidate worst;
    if (!solid(surface_, t)) return worst;
    std::array<Sample, 3> p;
    std::array<float, 3> h;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = surface_.vertices()[t.vertex[k]];
      h[k] = heights_[t.vertex[k]];
    }
    if (twice_area(p[0], p[1], p[2]) == 1) return worst;  // holds no other sample
    const Plane plane(p, h);
    const auto slope = static_cast<float>(plane.per_i);
    const int last = std::max({p[0].j, p[1].j, p[2].j});
    for (int j = std::min({p[0].j, p[1].j, p[2].j}); j <= last; ++j) {
      const RowEnds row(p, j);
      if (row.east < row.west) continue;
      const float* const heights =
          field_.heights.data() + static_cast<std::size_t>(j) * field_.width + row.west;
      const int count = row.east - row.west + 1;
      const auto first = static_cast<float>(plane(row.west, j));
      const float miss = largest_miss(heights, count, first, slope);
      if (!(miss > worst.error)) continue;
      const int i = row.west + first_miss(heights, count, first, slope, miss);
      worst = {miss, {static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)}};
    }
    return worst;
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
  std::vector<float> heights;
  heights.reserve(a.heights.size());
  for (const std::uint32_t before : a.surface.put_in_order()) heights.push_back(a.heights[before]);
  a.heights = std::move(heights);
}

Approximation greedy_insertion(const Heightfield& field, float largest_error, Progress& progress) {
  require_cells(field.width, field.depth, "tin");
  return Insertion(field, largest_error, progress).run();
}

}  // namespace terrabench::tin
