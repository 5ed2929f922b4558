#include "representations/ray_cast.h"

#include "representations/column_grid.h"
#include "representations/heightmap/heightmap.h"
#include "representations/plan_square.h"
#include "representations/ray_walk.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr float kNothing = -std::numeric_limits<float>::infinity();

// The squares between a heightmap's samples, and half a cell of level ground where the bounds reach farther.
struct HeightGround {
  explicit HeightGround(const Heightmap& map)
      : grid(map.grid()),
        heights(map.heights()),
        x(axis(grid.origin_x, grid.cell_x, grid.width, grid.bounds.low.x, grid.bounds.high.x, before_x)),
        z(axis(grid.origin_z, grid.cell_z, grid.depth, grid.bounds.low.z, grid.bounds.high.z, before_z)),
        floor(grid.bounds.low.y),
        tops(x.cells, z.cells, [&](int i, int j) { return top(i, j); }) {
    highest = tops.levels() == 0 ? top(0, 0) : tops.at(tops.levels(), 0, 0);
  }

  // As the planes between which Heightmap::mesh() puts its triangles.
  static PlanAxis axis(double origin, double cell, int samples, double low, double high, int& before) {
    before = origin > low ? 1 : 0;
    const bool beyond = high - (origin + (samples - 1) * cell) > 0.25 * cell;
    return {origin - before * cell, cell, low, high, std::max(1, samples - 1 + before + (beyond ? 1 : 0))};
  }

  CornerHeights corners(int i, int j) const {
    i -= before_x;
    j -= before_z;
    const int east = std::min(i + 1, grid.width - 1), south = std::min(j + 1, grid.depth - 1);
    i = std::max(i, 0);
    j = std::max(j, 0);
    const float* const upper =
        heights.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.width);
    const float* const lower =
        heights.data() + static_cast<std::size_t>(south) * static_cast<std::size_t>(grid.width);
    return {upper[i], upper[east], lower[i], lower[east]};
  }

  float top(int i, int j) const {
    const CornerHeights c = corners(i, j);
    return c.none() ? kNothing : c.highest();
  }

  bool solid(int i, int j, const RayPath& path, double t) const {
    const CornerHeights c = corners(i, j);
    return !c.none() && PlanSquare(x, z, i, j, c, path).below(t);
  }

  double change(int i, int j, const RayPath& path, Stretch at, double lowest, bool inside) const {
    const CornerHeights c = corners(i, j);
    if (!inside && lowest > c.highest()) return kNone;
    if (c.none()) return inside ? at.begin : kNone;
    return PlanSquare(x, z, i, j, c, path).change(at, inside);
  }

  double closest(const Ray& ray) const { return RayWalk(*this, ray).closest(); }
  std::size_t bytes() const { return tops.bytes(); }

  const HeightGrid& grid;
  std::span<const float> heights;
  int before_x = 0, before_z = 0;  // cells before the first sample
  PlanAxis x, z;
  double floor, highest = 0;
  TopPyramid tops;
};

// Spans, those that touch joined. The spans of column c are [starts[c], starts[c + 1]).
struct SpanGround {
  struct Part {
    float bottom, top;
  };

  SpanGround(const Representation& from, const ColumnGrid& grid)
      : x{grid.origin_x, grid.cell_x, grid.bounds().low.x, grid.bounds().high.x, grid.width},
        z{grid.origin_z, grid.cell_z, grid.bounds().low.z, grid.bounds().high.z, grid.depth},
        floor(grid.bounds().low.y),
        parts(read(from, grid)),
        tops(grid.width, grid.depth, [&](int i, int j) { return top(i, j); }) {
    highest = tops.levels() == 0 ? top(0, 0) : tops.at(tops.levels(), 0, 0);
  }

  std::vector<Part> read(const Representation& from, const ColumnGrid& grid) {
    std::vector<Part> all;
    starts.reserve(grid.columns() + 1);
    starts.push_back(0);
    std::vector<float> at_x(static_cast<std::size_t>(grid.width)), at_z(at_x.size());
    for (int i = 0; i < grid.width; ++i) at_x[static_cast<std::size_t>(i)] = grid.centre_x(i);
    SpanSink sink;
    for (int j = 0; j < grid.depth; ++j) {
      std::fill(at_z.begin(), at_z.end(), grid.centre_z(j));
      sink.clear();
      from.spans({at_x, at_z}, sink);
      for (std::size_t i = 0; i < at_x.size(); ++i) {
        for (const Span& span : sink.column(i)) {
          if (all.size() > starts.back() && all.back().top == span.bottom) {
            all.back().top = span.top;
          } else {
            all.push_back({span.bottom, span.top});
          }
        }
        starts.push_back(static_cast<std::uint32_t>(all.size()));
      }
    }
    all.shrink_to_fit();
    return all;
  }

  std::span<const Part> column(int i, int j) const {
    const std::size_t c =
        static_cast<std::size_t>(j) * static_cast<std::size_t>(x.cells) + static_cast<std::size_t>(i);
    return {parts.data() + starts[c], starts[c + 1] - starts[c]};
  }
  float top(int i, int j) const {
    const auto spans = column(i, j);
    return spans.empty() ? kNothing : spans.back().top;
  }
  // The first span that ends above y.
  static std::size_t above(std::span<const Part> spans, double y) {
    std::size_t k = 0;
    while (k < spans.size() && !(y < spans[k].top)) ++k;
    return k;
  }

  bool solid(int i, int j, const RayPath& path, double t) const {
    const auto spans = column(i, j);
    const double y = path.y(t);
    const std::size_t k = above(spans, y);
    return k < spans.size() && y >= spans[k].bottom;
  }

  double change(int i, int j, const RayPath& path, Stretch at, double lowest, bool inside) const {
    const auto spans = column(i, j);
    if (!inside && (spans.empty() || lowest > spans.back().top)) return kNone;
    const double from = path.y(at.begin), to = path.y(at.end);
    const std::size_t k = above(spans, from);
    if ((k < spans.size() && from >= spans[k].bottom) != inside) return at.begin;
    double face;
    if (path.direction.y > 0) {
      if (k == spans.size()) return kNone;
      face = inside ? spans[k].top : spans[k].bottom;
      if (to < face) return kNone;
    } else {
      if (inside ? k == spans.size() : k == 0) return kNone;
      face = inside ? spans[k].bottom : spans[k - 1].top;
      if (to >= face) return kNone;
    }
    return std::clamp((face - path.origin.y) / path.direction.y, at.begin, at.end);
  }

  double closest(const Ray& ray) const { return RayWalk(*this, ray).closest(); }
  std::size_t bytes() const { return tops.bytes() + heap_bytes(starts.data()) + heap_bytes(parts.data()); }

  PlanAxis x, z;
  double floor, highest = 0;
  std::vector<std::uint32_t> starts;
  std::vector<Part> parts;
  TopPyramid tops;
};

}  // namespace

std::unique_ptr<RayCaster> height_ray_caster(const Heightmap& map) {
  if (map.grid().width < 2 || map.grid().depth < 2) return nullptr;  // no area
  return std::make_unique<GroundCaster<HeightGround>>(map);
}

std::unique_ptr<RayCaster> span_ray_caster(const Representation& of, const ColumnGrid& columns) {
  return std::make_unique<GroundCaster<SpanGround>>(of, columns);
}

}  // namespace terrabench
