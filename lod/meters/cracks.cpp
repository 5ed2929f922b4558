#include "lod/meters/cracks.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "lod/meters/projector.h"
#include "lod/meters/surface_raster.h"

namespace terrabench {
namespace {

constexpr std::size_t kEdgesAtOnce = std::size_t{1} << 23;

// One side of a triangle, the lesser end first; `forward` when the triangle has it in this direction.
struct Edge {
  Corner low, high;
  bool forward;
};

auto key(const Edge& e) {
  return std::tuple(e.low.x, e.low.z, e.high.x, e.high.z, e.low.y, e.high.y, e.forward);
}
bool same_place(const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; }

std::size_t pass_of(const Edge& e, std::size_t passes) {
  std::uint64_t h = static_cast<std::uint32_t>(e.low.x) * 0x9E3779B97F4A7C15U;
  h = (h ^ static_cast<std::uint32_t>(e.low.z)) * 0xC2B2AE3D27D4EB4FU;
  return static_cast<std::size_t>((h >> 32) % passes);
}

// The edges of one pass, sorted. Clockwise triangles are turned first.
std::vector<Edge> edges_of(const Frame& frame, std::size_t pass, std::size_t passes) {
  tbb::enumerable_thread_specific<std::vector<Edge>> found;
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    std::vector<Edge>& mine = found.local();
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      const long long area = doubled_plan_area(&corners[k]);
      if (area == 0) continue;
      for (std::size_t e = 0; e < 3; ++e) {
        const Corner &from = corners[k + e], &to = corners[k + (e + 1) % 3];
        const bool forward = std::tie(from.x, from.z) < std::tie(to.x, to.z);
        const Edge edge{forward ? from : to, forward ? to : from, forward == (area > 0)};
        if (pass_of(edge, passes) == pass) mine.push_back(edge);
      }
    }
  });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& some : found) edges.insert(edges.end(), some.begin(), some.end());
  tbb::parallel_sort(edges.begin(), edges.end(),
                     [](const Edge& a, const Edge& b) { return key(a) < key(b); });
  return edges;
}

// A straight stretch of one side of a line, at positions `from` to `to` along it.
struct Stretch {
  int from = 0, to = 0;
  double y_from = 0, y_to = 0;

  double at(int t) const { return y_from + (y_to - y_from) * (t - from) / (to - from); }
  double size() const { return std::max(std::abs(y_from), std::abs(y_to)); }
};

// An edge that is not closed, and its line: all points with dx·z - dz·x = offset. Positions along it are x,
// or z where all x are equal.
struct Open {
  int dx, dz;
  long long offset;
  bool forward;
  bool on_border;  // of the terrain
  Stretch stretch;

  bool same_line(const Open& o) const { return dx == o.dx && dz == o.dz && offset == o.offset; }
  glm::dvec3 place(int t, double y, const Frame& frame) const {
    const double x = dx != 0 ? t : static_cast<double>(-offset);
    const double z = dx != 0 ? (static_cast<double>(offset) + static_cast<double>(dz) * t) / dx : t;
    return {x * frame.cell_x, y, z * frame.cell_z};
  }
};

// A total order, so that a sweep visits edges at the same place in a fixed order.
auto key(const Open& o) {
  const Stretch& s = o.stretch;
  return std::tuple(o.dx, o.dz, o.offset, o.forward, s.from, s.to, s.y_from, s.y_to);
}

Open open_from(const Edge& e, bool on_border) {
  int dx = e.high.x - e.low.x, dz = e.high.z - e.low.z;
  const int parts = std::gcd(dx, dz);
  dx /= parts;
  dz /= parts;
  const long long offset = static_cast<long long>(dx) * e.low.z - static_cast<long long>(dz) * e.low.x;
  const Stretch stretch =
      dx != 0 ? Stretch{e.low.x, e.high.x, e.low.y, e.high.y} : Stretch{e.low.z, e.high.z, e.low.y, e.high.y};
  return {dx, dz, offset, e.forward, on_border, stretch};
}

bool on_border(const Edge& e, int width, int depth) {
  return (e.low.x <= 0 && e.high.x <= 0) || (e.low.z <= 0 && e.high.z <= 0) ||
         (e.low.x >= width - 1 && e.high.x >= width - 1) || (e.low.z >= depth - 1 && e.high.z >= depth - 1);
}

// The edges that are not closed, each direction once; repeated edges are counted as overlaps.
std::vector<Open> open_edges(const Frame& frame, int width, int depth, CrackReport& report) {
  std::size_t triangles = 0;
  for (const Batch& batch : frame.batches) triangles += batch.index_count / 3;
  for (const FrameMesh& mesh : frame.meshes) triangles += mesh.triangles();
  const std::size_t passes = 3 * triangles / kEdgesAtOnce + 1;
  std::vector<Open> open;
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const std::vector<Edge> edges = edges_of(frame, pass, passes);
    for (std::size_t first = 0, end; first < edges.size(); first = end) {
      std::size_t count[2] = {0, 0};
      for (end = first; end < edges.size() && same_place(edges[first], edges[end]); ++end) {
        ++count[edges[end].forward ? 1 : 0];
      }
      report.overlaps += (std::max(count[0], std::size_t{1}) - 1) + (std::max(count[1], std::size_t{1}) - 1);
      const bool closed = count[0] > 0 && count[1] > 0;
      if (!closed) open.push_back(open_from(edges[first], on_border(edges[first], width, depth)));
    }
  }
  return open;
}

std::size_t flipped_triangles(const Frame& frame) {
  std::atomic<std::size_t> flipped = 0;
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    std::size_t here = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) here += doubled_plan_area(&corners[k]) < 0;
    flipped.fetch_add(here, std::memory_order_relaxed);
  });
  return flipped;
}

// Compares the two sides of one line.
class LineSweep {
 public:
  LineSweep(const Frame& frame, const Projector& project, CrackReport& report)
      : frame_(frame), project_(project), report_(report) {}

  // `line`: edges of one line, sorted by side and position.
  void sweep(std::span<const Open> line) {
    line_ = &line.front();
    split(line);
    if (line_->on_border) return;
    bool gap_before = false;
    for (std::size_t k = 0; k < stops_.size(); ++k) {
      const int here = stops_[k];
      const bool junction = inside(sides_[0], sides_[1], here) || inside(sides_[1], sides_[0], here);
      const Gaps after = k + 1 < stops_.size() ? compare(here, stops_[k + 1]) : Gaps{};
      const bool gap = gap_before || after.at_from;
      report_.t_junctions += junction ? 1 : 0;
      report_.open_t_junctions += junction && gap ? 1 : 0;
      report_.gaps += gap ? 1 : 0;
      gap_before = after.at_to;
    }
  }

 private:
  struct Side {
    std::vector<Stretch> stretches;
    std::size_t next = 0;  // the first that starts after the present position
    Stretch now;           // of those before `next`, the one that reaches farthest
  };
  struct Gaps {
    bool at_from = false, at_to = false;
  };

  void split(std::span<const Open> line) {
    stops_.clear();
    for (Side& side : sides_) {
      side.stretches.clear();
      side.next = 0;
      side.now = {};
    }
    int reach = 0;
    for (const Open& open : line) {
      std::vector<Stretch>& side = sides_[open.forward ? 1 : 0].stretches;
      if (!side.empty() && open.stretch.from < reach) ++report_.overlaps;
      reach = side.empty() ? open.stretch.to : std::max(reach, open.stretch.to);
      side.push_back(open.stretch);
      stops_.push_back(open.stretch.from);
      stops_.push_back(open.stretch.to);
    }
    std::sort(stops_.begin(), stops_.end());
    stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
  }

  static void advance(Side& side, int to) {
    for (; side.next < side.stretches.size() && side.stretches[side.next].from <= to; ++side.next) {
      if (side.next == 0 || side.stretches[side.next].to > side.now.to) side.now = side.stretches[side.next];
    }
  }

  // Whether an edge of `ends` starts or ends at t strictly inside an edge of `across`.
  static bool inside(const Side& ends, const Side& across, int t) {
    if (!(across.now.from < t && across.now.to > t)) return false;  // sides are not yet advanced to t
    const bool starts = ends.next < ends.stretches.size() && ends.stretches[ends.next].from == t;
    return starts || (ends.next > 0 && ends.now.to == t);
  }

  // Compares the sides between two stops, where both are straight.
  Gaps compare(int from, int to) {
    for (Side& side : sides_) advance(side, from);
    const Stretch &a = sides_[0].now, &b = sides_[1].now;
    const bool has_a = sides_[0].next > 0 && a.to >= to, has_b = sides_[1].next > 0 && b.to >= to;
    if (has_a && has_b) {
      const double rounding = std::max(a.size(), b.size()) * 0x1p-23;
      return {note_gap(from, a.at(from), b.at(from), rounding), note_gap(to, a.at(to), b.at(to), rounding)};
    }
    if (has_a || has_b) {
      const Stretch& only = has_a ? a : b;
      const glm::dvec3 p = line_->place(from, only.at(from), frame_);
      const glm::dvec3 q = line_->place(to, only.at(to), frame_);
      report_.bare_edges += project_.sees_segment(p, q) ? 1 : 0;
    }
    return {};
  }

  bool note_gap(int t, double y, double across, double rounding) {
    const double gap = std::abs(y - across);
    if (gap <= rounding) return false;
    report_.largest_gap_m = std::max(report_.largest_gap_m, gap);
    const glm::dvec3 p = line_->place(t, y, frame_), q = line_->place(t, across, frame_);
    if (project_.sees_segment(p, q)) {
      report_.largest_gap_px = std::max(report_.largest_gap_px, project_.pixels_between(p, q));
    }
    return true;
  }

  const Frame& frame_;
  const Projector& project_;
  CrackReport& report_;
  const Open* line_ = nullptr;
  Side sides_[2];
  std::vector<int> stops_;
};

// Overlaps: the samples of the full terrain that more than one triangle covers in plan.
//
// By one rule for all triangles, a sample on an edge belongs to one side of it, and a sample at a corner to
// one of the triangles around it. So a surface without overlaps covers no sample twice, even with
// T-junctions. Exact. Triangles without plan area (skirts) cover nothing; clockwise ones cover like others.
// O(triangles + rows that they cross), in parallel; one bit per sample.
constexpr int kBits = 64;  // samples per word

class Coverage {
 public:
  Coverage(int width, int depth)
      : width_(width),
        depth_(depth),
        words_((static_cast<std::size_t>(width) + kBits - 1) / kBits),
        bits_(words_ * static_cast<std::size_t>(depth), 0) {}

  // How many of the triangle's samples were covered before.
  std::size_t cover(const Corner* corners) {
    const bool turned = doubled_plan_area(corners) < 0;
    const Corner triangle[] = {corners[0], corners[turned ? 2 : 1], corners[turned ? 1 : 2]};
    const auto [first, last] = std::minmax({triangle[0].z, triangle[1].z, triangle[2].z});
    std::size_t again = 0;
    // The rule: a sample counts as displaced infinitesimally to the east and, by a smaller order, to the
    // south.
    for (int z = std::max(first, 0); z < std::min(last, depth_); ++z) {
      long long low = 0, high = width_ - 1;
      for (int e = 0; e < 3; ++e) {
        const Corner &p = triangle[e], &q = triangle[(e + 1) % 3];
        // Inside: (q.z - p.z)·(x - p.x) > (q.x - p.x)·(z - p.z).
        const long long slope = q.z - p.z, limit = static_cast<long long>(q.x - p.x) * (z - p.z);
        if (slope > 0) low = std::max(low, p.x - plan_triangle::floor_divide(-limit, slope));
        if (slope < 0) high = std::min(high, p.x - plan_triangle::floor_divide(limit, -slope) - 1);
        // Inside lies north of an edge that runs east, without its row, or south of one that runs west, with
        // its row.
        if (slope == 0 && (limit > 0 || (limit == 0 && q.x > p.x))) high = -1;
      }
      if (low <= high) again += cover_row(z, static_cast<int>(low), static_cast<int>(high));
    }
    return again;
  }

 private:
  std::size_t cover_row(int z, int low, int high) {
    std::size_t again = 0;
    for (int word = low / kBits; word <= high / kBits; ++word) {
      const int from = std::max(low - word * kBits, 0), to = std::min(high - word * kBits, kBits - 1);
      const std::uint64_t mask = (~std::uint64_t{0} >> (kBits - 1 - to)) & (~std::uint64_t{0} << from);
      const std::size_t at = static_cast<std::size_t>(z) * words_ + static_cast<std::size_t>(word);
      const std::uint64_t before =
          std::atomic_ref<std::uint64_t>(bits_[at]).fetch_or(mask, std::memory_order_relaxed);
      again += static_cast<std::size_t>(std::popcount(before & mask));
    }
    return again;
  }

  int width_, depth_;
  std::size_t words_;  // per row
  std::vector<std::uint64_t> bits_;
};

// The number of repeated coverings: a sample covered n times counts n - 1.
std::size_t samples_covered_again(const Frame& frame, int width, int depth) {
  Coverage coverage(width, depth);
  std::atomic<std::size_t> again = 0;
  for_drawn_triangles(frame, [&](std::span<const Corner> corners) {
    std::size_t here = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) {
      if (doubled_plan_area(&corners[k]) != 0) here += coverage.cover(&corners[k]);
    }
    again.fetch_add(here, std::memory_order_relaxed);
  });
  return again;
}

}  // namespace

CrackReport find_cracks(const Frame& frame, int width, int depth, const View& view) {
  CrackReport report;
  report.flipped = flipped_triangles(frame);
  // Endless ground has too many samples to mark.
  if (frame.first == glm::ivec2(0)) report.covered_again = samples_covered_again(frame, width, depth);
  std::vector<Open> open = open_edges(frame, width, depth, report);
  tbb::parallel_sort(open.begin(), open.end(), [](const Open& a, const Open& b) { return key(a) < key(b); });
  const Projector project(view);
  LineSweep lines(frame, project, report);
  for (std::size_t first = 0, end; first < open.size(); first = end) {
    for (end = first; end < open.size() && open[first].same_line(open[end]);) ++end;
    lines.sweep({&open[first], end - first});
  }
  return report;
}

}  // namespace terrabench
