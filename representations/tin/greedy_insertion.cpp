#include "representations/tin/greedy_insertion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

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

// The samples of a triangle by rows.
class Rows {
 public:
  explicit Rows(std::array<Sample, 3> p) : p_(p) {
    std::ranges::sort(p_, {}, [](Sample s) { return s.j; });
    long_ = per_row(p_[0], p_[2]);
    upper_ = per_row(p_[0], p_[1]);
    lower_ = per_row(p_[1], p_[2]);
  }
  int first() const { return p_[0].j; }
  int last() const { return p_[2].j; }
  // Of row j, west ≤ east unless it has none.
  struct Columns {
    int west, east;
  };
  Columns columns(int j) const {
    const double one = p_[0].i + (j - p_[0].j) * long_;
    const double other = j < p_[1].j || p_[1].j == p_[2].j ? p_[0].i + (j - p_[0].j) * upper_
                                                           : p_[1].i + (j - p_[1].j) * lower_;
    return {static_cast<int>(std::ceil(std::min(one, other) - kOnEdge)),
            static_cast<int>(std::floor(std::max(one, other) + kOnEdge))};
  }

 private:
  // A sample that is not on an edge is at least 2⁻¹⁶ cells from it along its row; rounding moves an edge by
  // less than 2⁻³⁰.
  static constexpr double kOnEdge = 0x1p-20;

  static double per_row(Sample a, Sample b) {
    return a.j == b.j ? 0 : static_cast<double>(b.i - a.i) / (b.j - a.j);
  }

  std::array<Sample, 3> p_;      // from north to south
  double long_, upper_, lower_;  // columns per row of the edges
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
  static constexpr float kListed = -1;  // the error of a triangle that waits for scan()

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

  // Inserts the worst sample of each triangle whose error exceeds the limit, unless this pass has already
  // changed the triangle. Returns whether any was inserted. The order follows a Z-order curve, so that
  // triangles near in space are near in memory.
  bool insert_above(float limit) {
    std::vector<Due> due;
    for (std::uint32_t t = 0; t < candidates_.size(); ++t) {
      if (candidates_[t].error > limit) due.push_back({along_z_curve(candidates_[t].at), t});
    }
    tbb::parallel_sort(due.begin(), due.end());
    std::vector<std::uint32_t> changed;
    std::size_t counted = 0;
    for (const Due& next : due) {
      if (!(candidates_[next.triangle].error > limit)) continue;
      add(candidates_[next.triangle].at, next.triangle, changed);
      candidates_.resize(surface_.triangles().size());
      for (std::size_t k = counted; k < changed.size(); ++k) {
        float& error = candidates_[changed[k]].error;
        if (error == kListed) continue;
        error = kListed;
        changed[counted++] = changed[k];
      }
      changed.resize(counted);
    }
    scan(changed);
    return !changed.empty();
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
    const Rows rows(p);
    for (int j = rows.first(); j <= rows.last(); ++j) {
      const auto [west, east] = rows.columns(j);
      if (east < west) continue;
      const float* const heights = field_.heights.data() + static_cast<std::size_t>(j) * field_.width + west;
      const int count = east - west + 1;
      const auto first = static_cast<float>(plane(west, j));
      const float miss = largest_miss(heights, count, first, slope);
      if (!(miss > worst.error)) continue;
      const int i = west + first_miss(heights, count, first, slope, miss);
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
