#include "representations/column_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/error.h"
#include "terrain/resampling.h"

namespace terrabench {
namespace {

// The spacing of floats at this magnitude: finer levels would share one height.
double least_step(double magnitude) { return magnitude > 0 ? std::exp2(std::ilogb(magnitude) - 23) : 0; }

int cells_along(double length, double cell) {
  return static_cast<int>(
      std::clamp(std::round(length / cell), 1.0, static_cast<double>(ColumnGrid::kMaxLevels)));
}

Error too_many_levels(double step, double range) {
  return usage_error(fmt::format("a step of {} m cuts a range of {} m into more than {} levels", step, range,
                                 ColumnGrid::kMaxLevels),
                     "parameter 'step'", "choose a larger step, or 0 for an automatic one");
}

}  // namespace

LevelRange ColumnGrid::quantise(float bottom, float top) const {
  const auto first_centre_from = [&](double y) {
    return static_cast<int>(
        std::clamp(std::ceil((y - origin_y) / step - 0.5), 0.0, static_cast<double>(levels)));
  };
  return {first_centre_from(bottom), first_centre_from(top)};
}

void ColumnGrid::save(ByteSink& out) const {
  for (const int n : {width, depth, levels}) out.put(n);
  for (const double metres : {origin_x, origin_y, origin_z, cell_x, step, cell_z}) out.put(metres);
}

ColumnGrid ColumnGrid::load(ByteSource& in) {
  ColumnGrid grid;
  for (int* n : {&grid.width, &grid.depth, &grid.levels}) *n = in.get<int>();
  for (double* metres :
       {&grid.origin_x, &grid.origin_y, &grid.origin_z, &grid.cell_x, &grid.step, &grid.cell_z}) {
    *metres = in.get<double>();
    if (!(std::abs(*metres) < 1e30)) in.fail("a position or size of the grid is not a number of metres");
  }
  if (grid.width < 1 || grid.depth < 1 || grid.levels < 1 || grid.width > kMaxColumns ||
      grid.depth > kMaxColumns || grid.levels > kMaxLevels || !(grid.cell_x > 0) || !(grid.step > 0) ||
      !(grid.cell_z > 0)) {
    in.fail("the grid's sizes are impossible");
  }
  return grid;
}

ColumnSampler::ColumnSampler(const TerrainSource& source, const Parameters& parameters,
                             int automatic_levels) {
  if (source.solid) {
    solid_ = &*source.solid;
    choose_grid(*solid_, parameters);
    return;
  }
  check_heights(*source.heights, source.name);
  resampled_ = at_resolution(*source.heights, parameters.integer("resolution"));
  heights_ = resampled_ ? &*resampled_ : &*source.heights;
  choose_grid(*heights_, parameters.number("step"), automatic_levels);
}

void ColumnSampler::choose_grid(const Solid& solid, const Parameters& parameters) {
  const glm::vec3 size = solid.bounds.size(), low = solid.bounds.low;
  if (!(std::min({size.x, size.y, size.z}) > 0 && std::isfinite(size.x + size.y + size.z) &&
        std::isfinite(low.x + low.y + low.z))) {
    throw bad_input("the solid's bounds enclose no volume", "solid", "give it finite bounds with low < high");
  }
  const std::int64_t asked = parameters.integer("resolution");
  const double resolution = asked == 0 ? kDefaultResolution : static_cast<double>(asked);
  const double cell = std::max({size.x, size.y, size.z}) / resolution;
  grid_.width = cells_along(size.x, cell);
  grid_.depth = cells_along(size.z, cell);
  grid_.levels = cells_along(size.y, cell);
  grid_.step = size.y / static_cast<double>(grid_.levels);
  if (const double step = parameters.number("step"); step > 0) {
    if (std::ceil(size.y / step) > ColumnGrid::kMaxLevels) throw too_many_levels(step, size.y);
    grid_.levels = static_cast<int>(std::ceil(size.y / step));
    grid_.step = step;
  }
  if (grid_.step < least_step(std::max(std::abs(low.y), std::abs(solid.bounds.high.y)))) {
    throw usage_error(
        fmt::format("levels of {} m cannot be distinguished at a height of {} m", grid_.step, low.y), "step",
        "choose a larger step, or move the solid to lower coordinates");
  }
  // Hours on any machine, at some ten million samples of a solid per second.
  constexpr double kMostSamples = std::uint64_t{1} << 38;
  if (const double samples = 1.0 * grid_.width * grid_.depth * grid_.levels; samples > kMostSamples) {
    throw environment_error(
        fmt::format("{} × {} columns of {} levels are {:.2g} samples of the solid, more than {:.2g}",
                    grid_.width, grid_.depth, grid_.levels, samples, kMostSamples),
        "resolution, step", "choose a lower resolution or a larger step");
  }
  grid_.cell_x = size.x / static_cast<double>(grid_.width);
  grid_.cell_z = size.z / static_cast<double>(grid_.depth);
  grid_.origin_x = low.x;
  grid_.origin_y = low.y;
  grid_.origin_z = low.z;
}

// The floor is a multiple of the step, so that whole metres stay exact for a power of two. It lies one cell
// below the lowest sample, and at least half a step, so that each column with data has at least one level.
void ColumnSampler::choose_grid(const Heightfield& field, double step, int automatic_levels) {
  const HeightRange range = height_range(field);
  const double lowest = range.lowest, highest = range.highest, depth = std::max(field.cell_x, field.cell_z);
  const double extent = highest - lowest + depth;
  const double finest = least_step(std::max(std::abs(lowest), std::abs(highest)) + depth);
  if (step == 0) {
    step = std::max(std::exp2(std::ceil(std::log2(extent / (automatic_levels - 2)))), finest);
  } else if (step < finest || extent / step > ColumnGrid::kMaxLevels - 2) {
    throw too_many_levels(step, extent);
  }
  double floor = std::floor((lowest - depth) / step) * step;
  if (lowest - floor < step / 2) floor -= step;
  grid_.width = field.width;
  grid_.depth = field.depth;
  grid_.levels = std::max(1, static_cast<int>(std::lround((highest - floor) / step)));
  grid_.step = step;
  grid_.cell_x = field.cell_x;
  grid_.cell_z = field.cell_z;
  grid_.origin_x = -0.5 * field.cell_x;
  grid_.origin_y = floor;
  grid_.origin_z = -0.5 * field.cell_z;
}

int ColumnSampler::top(int i, int j) const {
  const float height = heights_->at(i, j);
  if (Heightfield::is_no_data(height)) return 0;
  return std::clamp(static_cast<int>(std::lround((height - grid_.origin_y) / grid_.step)), 1, grid_.levels);
}

void ColumnSampler::sample(int i, int j, std::span<Material> out) const {
  out = out.first(static_cast<std::size_t>(grid_.levels));
  if (from_heights()) {
    const auto ground = out.begin() + top(i, j);
    std::fill(out.begin(), ground, Material::kBedrock);
    std::fill(ground, out.end(), Material::kAir);
  } else {
    solid_->column({grid_.centre_x(i), grid_.centre_z(j), grid_.centre_y(0), static_cast<float>(grid_.step)},
                   out);
  }
}

std::span<const ParameterSpec> column_parameters() {
  static const ParameterSpec kSpecs[] = {
      {"resolution", std::int64_t{0}, "samples",
       "columns along the longest side; 0: the samples of a heightfield, and 128 for a solid", 0, 65535},
      {"step", 0.0, "m",
       "height of a level; 0: the cell of a solid, and for heights a power of two that fits their range", 0,
       1e6},
  };
  return kSpecs;
}

std::vector<ParameterSpec> column_parameters_and(std::initializer_list<ParameterSpec> own) {
  std::vector<ParameterSpec> specs(column_parameters().begin(), column_parameters().end());
  specs.insert(specs.end(), own);
  return specs;
}

void check_heights(const Heightfield& field, std::string_view where) {
  const auto wrong = [&](std::string_view what) {
    return bad_input(what, where, "check the file in a GIS, or make it again from its source");
  };
  if (field.width < 1 || field.depth < 1 || field.width > ColumnGrid::kMaxColumns ||
      field.depth > ColumnGrid::kMaxColumns ||
      field.heights.size() != static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth)) {
    throw wrong(fmt::format("a heightfield of {} × {} samples is empty, too large or incomplete", field.width,
                            field.depth));
  }
  if (!(field.cell_x > 0 && field.cell_z > 0 && std::isfinite(field.cell_x + field.cell_z))) {
    throw wrong("the cell size is not a positive number of metres");
  }
  if (std::any_of(field.heights.begin(), field.heights.end(),
                  [](float height) { return std::isinf(height); })) {
    throw wrong("a height is infinite");
  }
  if (height_range(field).no_data == field.heights.size()) throw wrong("all samples are no-data");
}

void require_cells(int width, int depth, std::string_view where) {
  if (width >= 2 && depth >= 2) return;
  throw usage_error(
      fmt::format("a surface between samples needs at least 2 × 2 of them, got {} × {}", width, depth), where,
      "give more samples, or choose a representation of single columns, such as heightmap");
}

std::optional<Heightfield> at_resolution(const Heightfield& field, std::int64_t resolution) {
  const int longest = std::max(field.width, field.depth);
  if (resolution == 0 || resolution == longest) return std::nullopt;
  const auto scaled = [&](std::int64_t n) {
    if (n == 1) return 1;
    const double cells = static_cast<double>(n - 1) * static_cast<double>(resolution - 1) / (longest - 1);
    return 1 + std::max(n == longest ? 0 : 1, static_cast<int>(std::lround(cells)));
  };
  return resample_gridline(field, scaled(field.width), scaled(field.depth));
}

void check_edit(Columns where, std::span<const Span> what) {
  if (where.x.size() != what.size() || where.z.size() != what.size()) {
    throw usage_error(fmt::format("{} spans for {} columns", what.size(), where.size()), "edit",
                      "give one span per column");
  }
  for (std::size_t i = 0; i < what.size(); ++i) {
    if (!(what[i].bottom < what[i].top)) {
      throw usage_error(fmt::format("a span from {} to {} m", what[i].bottom, what[i].top),
                        fmt::format("edit, span {}", i), "the bottom must lie under the top");
    }
  }
}

}  // namespace terrabench
