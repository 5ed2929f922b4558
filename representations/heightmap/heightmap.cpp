#include "representations/heightmap/heightmap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "representations/column_grid.h"
#include "representations/heightmap/closed_mesh.h"

namespace terrabench {
namespace {

// Where a position lies between samples.
struct Between {
  int first, second;
  float weight;  // of the second; exactly 0 on a sample
};

// Positions are floats, so that a sample's own position misses it by some 2⁻²⁴ of the distance: snapped.
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
  width_ = field.width;
  depth_ = field.depth;
  cell_x_ = field.cell_x;
  cell_z_ = field.cell_z;
  bounds_ = {{0, bounds.low.y, 0}, {field.extent_x(), bounds.high.y, field.extent_z()}};
  heights_ = field.heights;
}

void Heightmap::take_topmost(const TerrainSource& source, const Parameters& parameters, Progress& progress) {
  const ColumnSampler sampler(source, parameters, ColumnGrid::kMaxLevels);
  const ColumnGrid& grid = sampler.grid();
  width_ = grid.width;
  depth_ = grid.depth;
  cell_x_ = grid.cell_x;
  cell_z_ = grid.cell_z;
  origin_x_ = grid.origin_x + 0.5 * cell_x_;
  origin_z_ = grid.origin_z + 0.5 * cell_z_;
  bounds_ = grid.bounds();
  require_memory(grid.columns() * sizeof(float), "heightmap");
  heights_.resize(grid.columns());
  progress.begin("heightmap", static_cast<std::uint64_t>(depth_));
  tbb::parallel_for(tbb::blocked_range<int>(0, depth_), [&](const tbb::blocked_range<int>& rows) {
    std::vector<Material> column(static_cast<std::size_t>(grid.levels));
    for (int j = rows.begin(); j < rows.end(); ++j) {
      for (int i = 0; i < width_; ++i) {
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
  if (!(x >= bounds_.low.x && x <= bounds_.high.x && z >= bounds_.low.z && z <= bounds_.high.z)) {
    return Heightfield::kNoData;
  }
  const Between u = between((x - origin_x_) / cell_x_, width_),
                v = between((z - origin_z_) / cell_z_, depth_);
  const float* const north = heights_.data() + static_cast<std::size_t>(v.first) * width_;
  const float* const south = heights_.data() + static_cast<std::size_t>(v.second) * width_;
  const float a = north[u.first] + u.weight * (north[u.second] - north[u.first]);
  const float b = south[u.first] + u.weight * (south[u.second] - south[u.first]);
  return a + v.weight * (b - a);
}

void Heightmap::spans(Columns where, SpanSink& out) const {
  for (std::size_t c = 0; c < where.size(); ++c) {
    const float top = height(where.x[c], where.z[c]);
    if (top > bounds_.low.y) out.add({bounds_.low.y, top, Material::kBedrock});
    out.end_column();
  }
}

// The structure's own samples, and the bounds where they lie further out; or even lines `cell` apart.
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

TriangleMesh Heightmap::mesh(MeshDetail detail) const {
  const std::vector<float> x = lines(detail.cell, bounds_.low.x, bounds_.high.x, origin_x_, cell_x_, width_);
  const std::vector<float> z = lines(detail.cell, bounds_.low.z, bounds_.high.z, origin_z_, cell_z_, depth_);
  std::vector<float> heights(x.size() * z.size());
  tbb::parallel_for(std::size_t{0}, z.size(), [&](std::size_t j) {
    for (std::size_t i = 0; i < x.size(); ++i) heights[j * x.size() + i] = height(x[i], z[j]);
  });
  return closed_mesh(x, z, heights, bounds_.low.y);
}

Memory Heightmap::memory() const {
  Memory memory = payload_memory(heights_);
  memory.index += heap_bytes(this);
  return memory;
}

void Heightmap::save(ByteSink& out) const {
  out.put(width_);
  out.put(depth_);
  for (const double metres : {origin_x_, origin_z_, cell_x_, cell_z_}) out.put(metres);
  out.put(bounds_);
  out.put_array(std::span<const float>(heights_));
}

std::unique_ptr<Representation> Heightmap::load(ByteSource& in) {
  std::unique_ptr<Heightmap> built(new Heightmap);
  built->width_ = in.get<int>();
  built->depth_ = in.get<int>();
  for (double* metres : {&built->origin_x_, &built->origin_z_, &built->cell_x_, &built->cell_z_}) {
    *metres = in.get<double>();
    if (!std::isfinite(*metres)) in.fail("a position or size is not a number of metres");
  }
  const Bounds bounds = built->bounds_ = in.get<Bounds>();
  if (built->width_ < 1 || built->depth_ < 1 || built->width_ > ColumnGrid::kMaxColumns ||
      built->depth_ > ColumnGrid::kMaxColumns || !(built->cell_x_ > 0 && built->cell_z_ > 0)) {
    in.fail("the grid's sizes cannot be");
  }
  if (!(bounds.low.x <= bounds.high.x && bounds.low.y <= bounds.high.y && bounds.low.z <= bounds.high.z &&
        std::isfinite(bounds.size().x + bounds.size().y + bounds.size().z))) {
    in.fail("the bounds cannot be");
  }
  built->heights_ = in.get_array<float>(static_cast<std::uint64_t>(built->width_) *
                                        static_cast<std::uint64_t>(built->depth_));
  if (std::any_of(built->heights_.begin(), built->heights_.end(), [](float h) { return std::isinf(h); })) {
    in.fail("a height is infinite");
  }
  return built;
}

}  // namespace terrabench
