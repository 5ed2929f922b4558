#include "representations/tin/tin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "representations/coding/height_codec.h"
#include "representations/column_grid.h"
#include "representations/heightmap/closed_mesh.h"
#include "representations/procedural_mesh/shell.h"
#include "representations/tin/reinsertion.h"
#include "representations/tin/tin_codec.h"
#include "terrain/error.h"
#include "terrain/tin/triangle_plane.h"

namespace terrabench {
namespace {

constexpr double kSteps = 0x1p20;  // per cell, of the positions that Locator takes

// A position in cells: on a sample if it is within a float's rounding of one, else a whole number of steps.
double in_cells(float at, double origin, double cell, int samples) {
  const double u = std::clamp((at - origin) / cell, 0.0, static_cast<double>(samples - 1));
  const double nearest = std::round(u);
  return std::abs(u - nearest) <= nearest * 0x1p-22 ? nearest : std::round(u * kSteps) / kSteps;
}

std::vector<ParameterSpec> make_parameters() {
  std::vector<ParameterSpec> specs(column_parameters().begin(), column_parameters().end());
  specs.push_back({"max_error", 0.0, "m",
                   "largest distance of a sample from the surface; 0: 1/256 of the range of heights", 0,
                   1e9});
  return specs;
}

// A saved triangulation: the vertices in rows. No value if a corner of the rectangle is missing.
std::optional<tin::Approximation> triangulate(const HeightGrid& grid, std::span<const tin::Sample> vertices,
                                              std::span<const float> heights) {
  tin::Approximation result{tin::Delaunay(grid.width, grid.depth), {}, {}};
  for (const tin::Sample corner : std::vector(result.surface.vertices())) {
    const auto at = std::ranges::lower_bound(vertices, corner, tin::before);
    if (at == vertices.end() || *at != corner) return std::nullopt;
    result.heights.push_back(heights[static_cast<std::size_t>(at - vertices.begin())]);
  }
  result.surface.reserve(vertices.size());
  std::vector<std::uint32_t> changed;
  std::uint32_t near = 0;
  tin::coarse_to_fine(vertices.size(), [&](std::size_t v) {
    changed.clear();
    near = result.surface.locate(vertices[v], near);
    if (result.surface.insert(vertices[v], near, changed) == result.heights.size()) {
      result.heights.push_back(heights[v]);
    }
  });
  put_in_order(result);
  return result;
}

std::pair<HeightGrid, float> load_head(ByteSource& in) {
  const HeightGrid grid = HeightGrid::load(in);
  if (grid.width < 2 || grid.depth < 2) in.fail("a triangulation has at least 2 × 2 samples");
  const auto largest_error = in.get<float>();
  if (!(largest_error >= 0) || std::isinf(largest_error)) in.fail("the largest error is impossible");
  return {grid, largest_error};
}

Heightfield as_field(const Heightmap& map) {
  Heightfield field = Heightfield::zeros(map.grid().width, map.grid().depth);
  field.heights.assign(map.heights().begin(), map.heights().end());
  return field;
}

}  // namespace

std::span<const ParameterSpec> Tin::parameters() {
  static const std::vector<ParameterSpec> specs = make_parameters();
  return specs;
}

Tin::Tin(const HeightGrid& grid, float largest_error, tin::Approximation ground)
    : grid_(grid),
      largest_error_(largest_error),
      ground_(std::move(ground)),
      locator_(ground_.surface, grid.width, grid.depth) {}

std::unique_ptr<Representation> Tin::build(const TerrainSource& source, const Parameters& parameters,
                                           Progress& progress) {
  const auto sampled = Heightmap::build(source, parameters, progress);
  const auto& map = static_cast<const Heightmap&>(*sampled);
  const Heightfield field = as_field(map);
  require_cells(field.width, field.depth, "tin");
  auto error = static_cast<float>(parameters.number("max_error"));
  if (error == 0) {
    const HeightRange range = height_range(field);
    error = std::max(0.0F, range.highest - range.lowest) / 256;
  }
  return std::unique_ptr<Representation>(
      new Tin(map.grid(), error, tin::greedy_insertion(field, error, progress)));
}

float Tin::height_in(const tin::Triangle& t, double i, double j) const {
  const tin::Plane plane(ground_.surface.corners(t), tin::corner_heights(t, ground_.heights));
  return static_cast<float>(plane(i, j));
}

std::optional<tin::Locator::Point> Tin::point_at(float x, float z) const {
  const Bounds& bounds = grid_.bounds;
  if (!(x >= bounds.low.x && x <= bounds.high.x && z >= bounds.low.z && z <= bounds.high.z)) return {};
  return {{in_cells(x, grid_.origin_x, grid_.cell_x, grid_.width),
           in_cells(z, grid_.origin_z, grid_.cell_z, grid_.depth)}};
}

float Tin::height(float x, float z) const {
  const auto p = point_at(x, z);
  return p ? height_at(*p, locator_.find(ground_.surface, *p)) : Heightfield::kNoData;
}

float Tin::height_at(tin::Locator::Point p, std::uint32_t at) const {
  const tin::Triangle& t = ground_.surface.triangles()[at];
  if (ground_.holes.empty() || ground_.holes[at] == 0) return height_in(t, p.i, p.j);
  // Inside a hole there is no data. On its rim, and on lines between two holes, lie vertices one cell apart.
  for (const std::uint32_t v : t.vertex) {
    const tin::Sample a = ground_.surface.vertices()[v];
    if (a.i == p.i && a.j == p.j) return ground_.heights[v];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t from = t.vertex[(k + 1) % 3], to = t.vertex[(k + 2) % 3];
    const tin::Sample a = ground_.surface.vertices()[from], b = ground_.surface.vertices()[to];
    if (std::abs(a.i - b.i) + std::abs(a.j - b.j) == 1 && tin::twice_area_to(a, b, p) == 0) {
      const auto along = static_cast<float>(std::abs(p.i - a.i) + std::abs(p.j - a.j));
      return ground_.heights[from] + along * (ground_.heights[to] - ground_.heights[from]);
    }
  }
  return Heightfield::kNoData;
}

void Tin::heights(Columns where, std::span<float> tops) const {
  std::array<tin::Locator::Point, tin::Locator::kAtOnce> points;
  std::array<std::uint32_t, tin::Locator::kAtOnce> columns, triangles;
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < where.size(); ++c) {
    tops[c] = Heightfield::kNoData;
    const auto p = point_at(where.x[c], where.z[c]);
    if (!p) continue;
    points[count] = *p;
    columns[count++] = c;
  }
  locator_.find(ground_.surface, {points.data(), count}, triangles);
  for (std::size_t k = 0; k < count; ++k) {
    for (const std::uint32_t v : ground_.surface.triangles()[triangles[k]].vertex)
      tin::prefetch(&ground_.heights[v]);
  }
  for (std::size_t k = 0; k < count; ++k) tops[columns[k]] = height_at(points[k], triangles[k]);
}

void Tin::spans(Columns where, SpanSink& out) const {
  std::array<float, tin::Locator::kAtOnce> tops;
  for (std::size_t first = 0; first < where.size(); first += tops.size()) {
    const std::size_t count = std::min(where.size() - first, tops.size());
    heights({where.x.subspan(first, count), where.z.subspan(first, count)}, tops);
    for (const float top : std::span(tops).first(count)) {
      if (top > grid_.bounds.low.y) out.add({grid_.bounds.low.y, top, Material::kBedrock});
      out.end_column();
    }
  }
}

void Tin::edit(Columns where, std::span<const Span> what) {
  check_edit(where, what);
  const Bounds& bounds = grid_.bounds;
  tin::Reinsertion change(ground_, locator_, grid_.width, grid_.depth, largest_error_,
                          std::max(std::abs(bounds.low.y), std::abs(bounds.high.y)));
  for (std::size_t c = 0; c < where.size(); ++c) {
    const auto at = grid_.nearest(where.x[c], where.z[c]);
    if (!at) continue;
    const tin::Sample sample{static_cast<std::uint16_t>(at->i), static_cast<std::uint16_t>(at->j)};
    const float before = change.height(sample), after = edited_height(before, what[c], bounds);
    if (after == before || (std::isnan(after) && std::isnan(before))) continue;
    change.set(sample, after);
  }
  if (change.finish()) edited_ = true;
}

glm::vec3 Tin::position(std::uint32_t vertex) const {
  const tin::Sample s = ground_.surface.vertices()[vertex];
  const LineGrid grid = lines();
  return {grid.x(s.i), ground_.heights[vertex], grid.z(s.j)};
}

TriangleMesh Tin::mesh(MeshDetail detail) const {
  if (detail.cell > 0) {
    const auto evenly = [&](float low, float high) {
      const double cells = std::clamp(std::round((static_cast<double>(high) - low) / detail.cell), 1.0,
                                      static_cast<double>(ColumnGrid::kMaxColumns));
      std::vector<float> at;
      for (int i = 0; i <= static_cast<int>(cells); ++i)
        at.push_back(static_cast<float>(low + i * (static_cast<double>(high) - low) / cells));
      at.back() = high;
      return at;
    };
    const std::vector<float> x = evenly(grid_.bounds.low.x, grid_.bounds.high.x),
                             z = evenly(grid_.bounds.low.z, grid_.bounds.high.z);
    std::vector<float> heights;
    heights.reserve(x.size() * z.size());
    for (const float south : z) {
      for (const float east : x) heights.push_back(height(east, south));
    }
    return closed_mesh(x, z, heights, grid_.bounds.low.y);
  }
  std::vector<glm::vec3> positions;
  positions.reserve(ground_.heights.size());
  std::vector<glm::u32vec3> triangles;
  triangles.reserve(ground_.surface.triangles().size());
  std::vector<std::uint32_t> numbers(ground_.heights.size(), tin::Delaunay::kNone);
  const auto number = [&](std::uint32_t v) {  // vertices of holes alone have none
    if (numbers[v] == tin::Delaunay::kNone) {
      numbers[v] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(position(v));
    }
    return numbers[v];
  };
  for (std::size_t t = 0; t < ground_.surface.triangles().size(); ++t) {
    if (!ground_.holes.empty() && ground_.holes[t] != 0) continue;
    const auto [a, b, c] = ground_.surface.triangles()[t].vertex;
    const std::uint32_t first = number(a), second = number(b), third = number(c);
    triangles.emplace_back(first, third, second);  // seen from above: the second axis points south
  }
  add_margin(numbers, positions, triangles);
  return close_down(std::move(positions), std::move(triangles), grid_.bounds.low.y);
}

// Between the outermost samples and the bounds, half a cell for solids, the border's height continues.
void Tin::add_margin(std::span<const std::uint32_t> numbers, std::vector<glm::vec3>& positions,
                     std::vector<glm::u32vec3>& triangles) const {
  const Bounds& bounds = grid_.bounds;
  const LineGrid grid = lines();
  const glm::vec2 first(grid.x(0), grid.z(0)), last(grid.x(grid.width - 1), grid.z(grid.depth - 1));
  const auto outward = [&](glm::vec3 p) {
    const bool west = p.x <= first.x, east = p.x >= last.x, north = p.z <= first.y, south = p.z >= last.y;
    return glm::vec3(west   ? bounds.low.x
                     : east ? bounds.high.x
                            : p.x,
                     p.y,
                     north   ? bounds.low.z
                     : south ? bounds.high.z
                             : p.z);
  };
  if (bounds.low.x >= first.x && bounds.high.x <= last.x) return;
  std::vector<std::uint32_t> copy(positions.size(), tin::Delaunay::kNone);
  const std::vector<DirectedEdge> border = [&] {
    std::vector<DirectedEdge> edges;
    for (std::size_t t = 0; t < ground_.surface.triangles().size(); ++t) {
      const tin::Triangle& at = ground_.surface.triangles()[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const bool hole = !ground_.holes.empty() && ground_.holes[t] != 0;
        if (at.neighbour[k] == tin::Delaunay::kNone && !hole)
          edges.push_back({numbers[at.vertex[(k + 2) % 3]], numbers[at.vertex[(k + 1) % 3]]});
      }
    }
    return edges;
  }();
  const auto copied = [&](std::uint32_t v) {
    if (copy[v] == tin::Delaunay::kNone) {
      copy[v] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(outward(positions[v]));
    }
    return copy[v];
  };
  for (const auto [from, to] : border) {
    const std::uint32_t outer_from = copied(from), outer_to = copied(to);
    triangles.emplace_back(to, from, outer_from);
    triangles.emplace_back(to, outer_from, outer_to);
  }
}

Memory Tin::memory() const {
  Memory memory = payload_memory(ground_.heights);
  memory += payload_memory(ground_.surface.vertices());
  memory += index_memory(ground_.surface.triangles());
  memory += index_memory(ground_.holes);
  memory += locator_.memory();
  memory.index += heap_bytes(this);
  return memory;
}

tin::Approximation Tin::in_order() const {
  tin::Approximation ordered = ground_;
  if (edited_) put_in_order(ordered);
  return ordered;
}

void Tin::save(ByteSink& out) const {
  const tin::Approximation ground = in_order();
  grid_.save(out);
  out.put(largest_error_);
  out.put(static_cast<std::uint64_t>(ground.heights.size()));
  out.put_array(std::span(ground.surface.vertices()));
  out.put_array(std::span<const float>(ground.heights));
  out.put(static_cast<std::uint8_t>(!ground.holes.empty()));
  out.put_array(std::span<const std::uint8_t>(ground.holes));
}

std::unique_ptr<Representation> Tin::load(ByteSource& in) {
  const auto [grid, largest_error] = load_head(in);
  const auto count = in.get<std::uint64_t>();
  const std::vector<tin::Sample> vertices = in.get_array<tin::Sample>(count);
  std::vector<float> heights = in.get_array<float>(count);
  if (std::any_of(heights.begin(), heights.end(), [](float h) { return std::isinf(h); }))
    in.fail("a height is infinite");
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (vertices[v].i >= grid.width || vertices[v].j >= grid.depth) in.fail("a vertex lies outside the grid");
    if (v > 0 && !before(vertices[v - 1], vertices[v])) in.fail("the vertices are not in order");
  }
  std::optional<tin::Approximation> restored = triangulate(grid, vertices, heights);
  if (!restored) in.fail("a corner of the grid is no vertex");
  if (in.get<std::uint8_t>() != 0) {
    restored->holes = in.get_array<std::uint8_t>(restored->surface.triangles().size());
    for (std::uint8_t& hole : restored->holes) hole = hole != 0 ? 1 : 0;
  }
  return std::unique_ptr<Representation>(new Tin(grid, largest_error, std::move(*restored)));
}

bool Tin::encode(double largest_error, ByteSink& out) const {
  grid_.save(out);
  out.put(largest_error_);
  tin::encode(in_order(), grid_.width, grid_.depth, step_for(ground_.heights, largest_error), out);
  return true;
}

std::unique_ptr<Representation> Tin::decode(ByteSource& in) {
  const auto [grid, largest_error] = load_head(in);
  tin::Approximation decoded = tin::decode(in, grid.width, grid.depth);
  clamp_heights(decoded.heights, grid.bounds.low.y, grid.bounds.high.y);
  return std::unique_ptr<Representation>(new Tin(grid, largest_error, std::move(decoded)));
}

LineGrid Tin::lines() const {
  return {grid_.width, grid_.depth, grid_.origin_x, grid_.origin_z, grid_.cell_x, grid_.cell_z, {}};
}

std::vector<std::pair<std::string, std::string>> Tin::facts() const {
  return {{"triangulation", fmt::format("{} vertices, {} triangles", ground_.heights.size(), triangles())}};
}

}  // namespace terrabench
