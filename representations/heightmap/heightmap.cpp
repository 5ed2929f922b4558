#include "representations/heightmap/heightmap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/coding/height_codec.h"
#include "representations/column_grid.h"
#include "representations/heightmap/closed_mesh.h"
#include "representations/line_grid.h"
#include "representations/ray_cast.h"

namespace terrabench {
namespace {

// A position between two samples.
struct Between {
  int first, second;
  float weight;  // of the second; exactly 0 on a sample
};

// Positions are floats, so that a sample's own position is off by about 2⁻²⁴ of its value: snapped.
Between between(double position, int samples) {
  const double u = std::clamp(position, 0.0, static_cast<double>(samples - 1)), nearest = std::round(u);
  if (std::abs(u - nearest) <= nearest * 0x1p-22) {
    const int at = static_cast<int>(nearest);
    return {at, at, 0};
  }
  const int first = static_cast<int>(u);
  return {first, first + 1, static_cast<float>(u - first)};
}

}  // namespace

std::unique_ptr<Representation> Heightmap::build(const TerrainSource& source, const Parameters& parameters,
                                                 Progress& progress) {
  std::unique_ptr<Heightmap> built(new Heightmap);
  if (source.solid) {
    built->take_topmost(source, parameters, progress);
  } else {
    check_heights(*source.heights, source.name);
    const auto resampled = at_resolution(*source.heights, parameters.integer("resolution"));
    built->take_heights(resampled ? *resampled : *source.heights, source.bounds());
  }
  return built;
}

void Heightmap::take_heights(const Heightfield& field, const Bounds& bounds) {
  grid_.width = field.width;
  grid_.depth = field.depth;
  grid_.cell_x = field.cell_x;
  grid_.cell_z = field.cell_z;
  grid_.bounds = {{0, bounds.low.y, 0}, {field.extent_x(), bounds.high.y, field.extent_z()}};
  heights_ = field.heights;
}

void Heightmap::take_topmost(const TerrainSource& source, const Parameters& parameters, Progress& progress) {
  const ColumnSampler sampler(source, parameters, ColumnGrid::kMaxLevels);
  const ColumnGrid& grid = sampler.grid();
  grid_.width = grid.width;
  grid_.depth = grid.depth;
  grid_.cell_x = grid.cell_x;
  grid_.cell_z = grid.cell_z;
  grid_.origin_x = grid.origin_x + 0.5 * grid_.cell_x;
  grid_.origin_z = grid.origin_z + 0.5 * grid_.cell_z;
  grid_.bounds = grid.bounds();
  require_memory(grid.columns() * sizeof(float), "heightmap");
  heights_.resize(grid.columns());
  progress.begin("heightmap", static_cast<std::uint64_t>(grid_.depth));
  tbb::parallel_for(tbb::blocked_range<int>(0, grid_.depth), [&](const tbb::blocked_range<int>& rows) {
    std::vector<Material> column(static_cast<std::size_t>(grid.levels));
    for (int j = rows.begin(); j < rows.end(); ++j) {
      for (int i = 0; i < grid_.width; ++i) {
        sampler.sample(i, j, column);
        int top = grid.levels;
        while (top > 0 && column[static_cast<std::size_t>(top) - 1] == Material::kAir) --top;
        heights_[grid.index(i, j)] = top == 0 ? Heightfield::kNoData : grid.edge_y(top);
      }
      progress.advance();
    }
  });
}

float Heightmap::height(float x, float z) const {
  if (!(x >= grid_.bounds.low.x && x <= grid_.bounds.high.x && z >= grid_.bounds.low.z &&
        z <= grid_.bounds.high.z)) {
    return Heightfield::kNoData;
  }
  const Between u = between((x - grid_.origin_x) / grid_.cell_x, grid_.width),
                v = between((z - grid_.origin_z) / grid_.cell_z, grid_.depth);
  const float* const north = heights_.data() + static_cast<std::size_t>(v.first) * grid_.width;
  const float* const south = heights_.data() + static_cast<std::size_t>(v.second) * grid_.width;
  const float a = north[u.first] + u.weight * (north[u.second] - north[u.first]);
  const float b = south[u.first] + u.weight * (south[u.second] - south[u.first]);
  return a + v.weight * (b - a);
}

void Heightmap::spans(Columns where, SpanSink& out) const {
  for (std::size_t c = 0; c < where.size(); ++c) {
    const float top = height(where.x[c], where.z[c]);
    if (top > grid_.bounds.low.y) out.add({grid_.bounds.low.y, top, Material::kBedrock});
    out.end_column();
  }
}

// The structure's own samples, and the bounds where these lie outside; or evenly spaced lines `cell` apart.
std::vector<float> Heightmap::lines(float cell, float low, float high, double origin, double own_cell,
                                    int samples) const {
  std::vector<float> at;
  if (cell > 0 && high > low) {
    const double cells = std::clamp(std::round((static_cast<double>(high) - low) / cell), 1.0,
                                    static_cast<double>(ColumnGrid::kMaxColumns));
    for (int i = 0; i <= static_cast<int>(cells); ++i)
      at.push_back(static_cast<float>(low + i * (high - low) / cells));
    at.back() = high;
    return at;
  }
  for (int i = 0; i < samples; ++i)
    at.push_back(std::clamp(static_cast<float>(origin + i * own_cell), low, high));
  if (at.front() > low) at.insert(at.begin(), low);
  if (at.back() < high && static_cast<double>(high) - at.back() > 0.25 * own_cell) at.push_back(high);
  at.back() = high;
  return at;
}

std::optional<HeightGrid::Place> HeightGrid::nearest(float x, float z) const {
  if (!(x >= bounds.low.x && x <= bounds.high.x && z >= bounds.low.z && z <= bounds.high.z)) return {};
  const auto index = [](double at, int samples) {
    return static_cast<int>(std::clamp(std::lround(at), 0L, static_cast<long>(samples - 1)));
  };
  return Place{index((x - origin_x) / cell_x, width), index((z - origin_z) / cell_z, depth)};
}

float edited_height(float height, const Span& what, const Bounds& bounds) {
  const float bottom = std::max(what.bottom, bounds.low.y), top = std::min(what.top, bounds.high.y);
  if (what.material != Material::kAir) return bottom < top && !(height >= top) ? top : height;
  if (what.top < height || !(bottom < height)) return height;  // a roof stays, or nothing was there
  return bottom > bounds.low.y ? bottom : Heightfield::kNoData;
}

void Heightmap::edit(Columns where, std::span<const Span> what) {
  check_edit(where, what);
  for (std::size_t c = 0; c < where.size(); ++c) {
    const auto at = grid_.nearest(where.x[c], where.z[c]);
    if (!at) continue;
    float& height = heights_[static_cast<std::size_t>(at->j) * static_cast<std::size_t>(grid_.width) +
                             static_cast<std::size_t>(at->i)];
    height = edited_height(height, what[c], grid_.bounds);
  }
}

TriangleMesh Heightmap::mesh(MeshDetail detail) const {
  const std::vector<float> x =
      lines(detail.cell, grid_.bounds.low.x, grid_.bounds.high.x, grid_.origin_x, grid_.cell_x, grid_.width);
  const std::vector<float> z =
      lines(detail.cell, grid_.bounds.low.z, grid_.bounds.high.z, grid_.origin_z, grid_.cell_z, grid_.depth);
  std::vector<float> heights(x.size() * z.size());
  tbb::parallel_for(std::size_t{0}, z.size(), [&](std::size_t j) {
    for (std::size_t i = 0; i < x.size(); ++i) heights[j * x.size() + i] = height(x[i], z[j]);
  });
  return closed_mesh(x, z, heights, grid_.bounds.low.y);
}

Memory Heightmap::memory() const {
  Memory memory = payload_memory(heights_);
  memory.index += heap_bytes(this);
  return memory;
}

void HeightGrid::save(ByteSink& out) const {
  out.put(width);
  out.put(depth);
  for (const double metres : {origin_x, origin_z, cell_x, cell_z}) out.put(metres);
  out.put(bounds);
}

HeightGrid HeightGrid::load(ByteSource& in) {
  HeightGrid grid;
  grid.width = in.get<int>();
  grid.depth = in.get<int>();
  for (double* metres : {&grid.origin_x, &grid.origin_z, &grid.cell_x, &grid.cell_z}) {
    *metres = in.get<double>();
    if (!std::isfinite(*metres)) in.fail("a position or size is not a number of metres");
  }
  grid.bounds = in.get<Bounds>();
  if (grid.width < 1 || grid.depth < 1 || grid.width > ColumnGrid::kMaxColumns ||
      grid.depth > ColumnGrid::kMaxColumns || !(grid.cell_x > 0 && grid.cell_z > 0)) {
    in.fail("the grid's sizes are impossible");
  }
  const Bounds& bounds = grid.bounds;
  if (!(bounds.low.x <= bounds.high.x && bounds.low.y <= bounds.high.y && bounds.low.z <= bounds.high.z &&
        std::isfinite(bounds.size().x + bounds.size().y + bounds.size().z))) {
    in.fail("the bounds are impossible");
  }
  return grid;
}

void Heightmap::save(ByteSink& out) const {
  grid_.save(out);
  out.put_array(std::span<const float>(heights_));
}

std::unique_ptr<Representation> Heightmap::load(ByteSource& in) {
  std::unique_ptr<Heightmap> built(new Heightmap);
  built->grid_ = HeightGrid::load(in);
  built->heights_ = in.get_array<float>(static_cast<std::uint64_t>(built->grid_.width) *
                                        static_cast<std::uint64_t>(built->grid_.depth));
  if (std::any_of(built->heights_.begin(), built->heights_.end(), [](float h) { return std::isinf(h); })) {
    in.fail("a height is infinite");
  }
  return built;
}

bool Heightmap::encode(double largest_error, ByteSink& out) const {
  grid_.save(out);
  encode_heights(heights_, grid_.width, step_for(heights_, largest_error), out);
  return true;
}

std::unique_ptr<Representation> Heightmap::decode(ByteSource& in) {
  std::unique_ptr<Heightmap> built(new Heightmap);
  built->grid_ = HeightGrid::load(in);
  built->heights_ = decode_heights(in, built->grid_.width, built->grid_.depth);
  clamp_heights(built->heights_, built->grid_.bounds.low.y, built->grid_.bounds.high.y);
  return built;
}

LineGrid Heightmap::lines() const {
  return {grid_.width, grid_.depth, grid_.origin_x, grid_.origin_z, grid_.cell_x, grid_.cell_z, {}};
}

std::optional<LineGrid> Heightmap::edited_lines() const { return lines(); }

std::unique_ptr<RayCaster> Heightmap::ray_caster() const { return height_ray_caster(*this); }

}  // namespace terrabench
