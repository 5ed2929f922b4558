#include "representations/implicit/implicit_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "representations/implicit/field_rays.h"
#include "representations/layered_stack/thermal_erosion.h"
#include "representations/line_grid.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr double kAutomaticLevels = 1024;

double chosen_radius(const ColumnGrid& grid, double radius) {
  return radius > 0 ? radius : 2 * std::max(grid.cell_x, grid.cell_z);
}

FieldLattice chosen_lattice(const ColumnGrid& grid, double cell) {
  const Bounds bounds = grid.bounds();
  const glm::vec3 size = bounds.size();
  if (!(cell > 0)) {
    cell = std::max({grid.cell_x, grid.cell_z, static_cast<double>(size.y) / kAutomaticLevels});
  }
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest / cell <= ImplicitSurface::kMaxCells) || !(static_cast<float>(cell) > 0)) {
    throw usage_error(fmt::format("cells of {} m divide {} m into more than {} cells", cell, longest,
                                  ImplicitSurface::kMaxCells),
                      "parameter 'cell'", "choose larger cells, or 0 for automatic ones");
  }
  return {bounds, static_cast<float>(cell)};
}

}  // namespace

std::span<const ParameterSpec> ImplicitSurface::parameters() {
  static const std::vector<ParameterSpec> kSpecs = column_parameters_and({
      choice("kernel", kKernelNames, "support of the convolution; the cube is faster"),
      {"radius", 0.0, "m", "of the kernel; 0: two columns", 0, 1e9},
      {"cell", 0.0, "m",
       "distance of the points at which the surface is sampled; 0: one column, or a 1024th of "
       "the terrain's height if that is more",
       0, 1e9},
      choice("extractor", kExtractorNames, "of the surface from the samples"),
  });
  return kSpecs;
}

ImplicitSurface::ImplicitSurface(std::unique_ptr<LayeredStack> stack, Kernel kernel, double radius,
                                 double cell, Extractor extractor)
    : stack_(std::move(stack)),
      field_(*stack_, kernel, chosen_radius(stack_->grid(), radius)),
      lattice_(chosen_lattice(stack_->grid(), cell)),
      extractor_(extractor) {
  const auto along = [](int cells) { return (cells + kChunkCells - 1) / kChunkCells; };
  chunks_ = {along(lattice_.cells.x), along(lattice_.cells.z)};
  versions_.assign(static_cast<std::size_t>(chunks_.x) * static_cast<std::size_t>(chunks_.y), 0);
}

std::unique_ptr<Representation> ImplicitSurface::build(const TerrainSource& source,
                                                       const Parameters& parameters, Progress& progress) {
  return build_surface(source, parameters, progress);
}

std::unique_ptr<ImplicitSurface> ImplicitSurface::build_surface(const TerrainSource& source,
                                                                const Parameters& parameters,
                                                                Progress& progress) {
  return std::make_unique<ImplicitSurface>(LayeredStack::build_stack(source, parameters, progress),
                                           static_cast<Kernel>(parameters.choice("kernel")),
                                           parameters.number("radius"), parameters.number("cell"),
                                           static_cast<Extractor>(parameters.choice("extractor")));
}

ThermalErosion ImplicitSurface::erode_to(double talus, Progress& progress) {
  return erode_thermally(*stack_, *this, {.talus = talus}, progress);
}

std::optional<LineGrid> ImplicitSurface::edited_lines() const { return stack_->edited_lines(); }

void ImplicitSurface::save_field(ByteSink& out) const {
  out.put(field_.radius());
  out.put(lattice_.cell);
  out.put(static_cast<std::uint8_t>(field_.kernel()));
  out.put(static_cast<std::uint8_t>(extractor_));
}

void ImplicitSurface::save(ByteSink& out) const {
  stack_->save(out);
  save_field(out);
}

bool ImplicitSurface::encode(double largest_error, ByteSink& out) const {
  stack_->encode(largest_error, out);
  save_field(out);
  return true;
}

std::unique_ptr<Representation> ImplicitSurface::load(ByteSource& in) {
  return with_field(LayeredStack::load(in), in);
}
std::unique_ptr<Representation> ImplicitSurface::decode(ByteSource& in) {
  return with_field(LayeredStack::decode(in), in);
}

std::unique_ptr<Representation> ImplicitSurface::with_field(std::unique_ptr<Representation> stack,
                                                            ByteSource& in) {
  const auto radius = in.get<double>();
  const auto cell = in.get<float>();
  const auto kernel = in.get<std::uint8_t>(), extractor = in.get<std::uint8_t>();
  if (!(radius > 0 && std::isfinite(radius)) || !(cell > 0 && std::isfinite(cell)) ||
      kernel >= kKernelNames.size() || extractor >= kExtractorNames.size()) {
    in.fail("the kernel or the lattice is impossible");
  }
  try {
    return std::make_unique<ImplicitSurface>(
        std::unique_ptr<LayeredStack>(static_cast<LayeredStack*>(stack.release())),
        static_cast<Kernel>(kernel), radius, cell, static_cast<Extractor>(extractor));
  } catch (const Error& error) {
    in.fail(error.what());
  }
}

void ImplicitSurface::spans(Columns where, SpanSink& out) const {
  const ColumnLookup lookup(stack_->grid());
  std::vector<float> y, values;
  for (int k = 0; k <= lattice_.cells.y; ++k) y.push_back(lattice_.position(1, k));
  values.resize(y.size());
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    if (lookup.column(where.x[c], where.z[c], i, j)) {
      field_.line(where.x[c], where.z[c], y, values);
      Span span{y.front(), y.front(), Material::kBedrock};
      bool any = false;  // whether `span` is begun or waits for what may touch it
      const auto finish = [&] {
        if (any && span.bottom < span.top) out.add(span);
        any = false;
      };
      const auto crossing = [&](std::size_t k) {  // between k and k + 1, as the mesh has it
        const float t = values[k] / (values[k] - values[k + 1]);
        return (1 - t) * y[k] + t * y[k + 1];
      };
      for (std::size_t k = 0; k < y.size(); ++k) {
        if (!(values[k] > 0)) continue;
        const float bottom = k == 0 ? y[0] : values[k - 1] > 0 ? span.bottom : crossing(k - 1);
        if (k == 0 || !(values[k - 1] > 0)) {
          if (!any || bottom > span.top) {
            finish();
            span.bottom = bottom;
          }
          any = true;
        }
        const bool last = k + 1 == y.size();
        if (last || !(values[k + 1] > 0)) span.top = last ? y[k] : crossing(k);
      }
      finish();
    }
    out.end_column();
  }
}

void ImplicitSurface::materials(Points where, std::span<Material> out) const {
  const ColumnLookup lookup(stack_->grid());
  const int levels = lattice_.cells.y;
  std::vector<float> y, values;
  for (int k = 0; k <= levels; ++k) y.push_back(lattice_.position(1, k));
  values.resize(y.size());
  const auto same_line = [&](std::size_t a, std::size_t b) {
    return where.x[a] == where.x[b] && where.z[a] == where.z[b];
  };
  bool whole = false;  // whether `values` holds the whole line of the position
  for (std::size_t p = 0; p < where.size(); ++p) {
    out[p] = Material::kAir;
    whole = whole && same_line(p - 1, p);
    int i, j;
    const float at = where.y[p];
    if (!(at >= y.front() && at < y.back()) || !lookup.column(where.x[p], where.z[p], i, j)) continue;
    auto k = static_cast<std::size_t>(
        std::clamp(static_cast<int>((at - y.front()) / lattice_.cell), 0, levels - 1));
    if (at < y[k]) --k;
    if (at >= y[k + 1]) ++k;
    if (!whole) {
      whole = p + 1 < where.size() && same_line(p, p + 1);
      const std::size_t first = whole ? 0 : k, count = whole ? y.size() : 2;
      field_.line(where.x[p], where.z[p], std::span(y).subspan(first, count),
                  std::span(values).subspan(first, count));
    }
    const float below = values[k], above = values[k + 1];
    bool solid = below > 0;
    if (solid != (above > 0)) {
      const float t = below / (below - above), crossing = (1 - t) * y[k] + t * y[k + 1];
      solid = solid == (at < crossing);
    }
    if (solid) out[p] = Material::kBedrock;
  }
}

void ImplicitSurface::edit(Columns where, std::span<const Span> what) {
  stack_->edit(where, what);
  const ColumnLookup lookup(stack_->grid());
  for (std::size_t c = 0; c < where.size(); ++c) {
    int i, j;
    const LevelRange levels = stack_->grid().quantise(what[c].bottom, what[c].top);
    if (levels.begin < levels.end && lookup.column(where.x[c], where.z[c], i, j)) touch(i, j);
  }
}

// Field values change within the radius of the column, and normals one cell farther.
void ImplicitSurface::touch(int column_i, int column_j) {
  const ColumnGrid& grid = stack_->grid();
  const double reach = field_.radius() + field_.rounding() + lattice_.cell;
  const auto range = [&](double low, double high, int axis, int count) {
    const double size = static_cast<double>(lattice_.cell) * kChunkCells;
    const double first = std::ceil((low - reach - lattice_.low[axis]) / size) - 1,
                 last = std::floor((high + reach - lattice_.low[axis]) / size);
    return std::pair(static_cast<int>(std::clamp(first, 0.0, count - 1.0)),
                     static_cast<int>(std::clamp(last, 0.0, count - 1.0)));
  };
  const auto [i0, i1] = range(grid.edge_x(column_i), grid.edge_x(column_i + 1), 0, chunks_.x);
  const auto [j0, j1] = range(grid.edge_z(column_j), grid.edge_z(column_j + 1), 2, chunks_.y);
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) ++versions_[number({i, j})];
  }
}

TriangleMesh ImplicitSurface::mesh(MeshDetail detail) const {
  const glm::vec3 size = bounds().size();
  const float largest = std::max({size.x, size.y, size.z});
  if (!(detail.cell > lattice_.cell)) return closed_surface(field_, lattice_, extractor_);
  return closed_surface(field_, {bounds(), std::min(detail.cell, std::max(largest, lattice_.cell))},
                        extractor_);
}

TriangleMesh ImplicitSurface::chunk(glm::ivec2 at, int detail) const {
  if (at.x < 0 || at.y < 0 || at.x >= chunks_.x || at.y >= chunks_.y || detail < 0 ||
      kChunkCells >> std::min(detail, 30) == 0) {
    throw usage_error(
        fmt::format("no chunk ({}, {}) of detail {}", at.x, at.y, detail), "implicit surface",
        fmt::format("there are {} × {} chunks of {} cells along a side", chunks_.x, chunks_.y, kChunkCells));
  }
  const FieldLattice lattice(bounds(), std::ldexp(lattice_.cell, detail));
  const int side = kChunkCells >> detail;
  const glm::ivec2 begin = at * side,
                   end{std::min(begin.x + side, lattice.cells.x), std::min(begin.y + side, lattice.cells.z)};
  if (begin.x >= end.x || begin.y >= end.y) return {};
  SurfaceBlock block =
      extract(extractor_, {field_, lattice, begin, end, false, detail == 0 ? 0 : lattice_.cell});
  return {std::move(block.positions), std::move(block.normals), std::move(block.indices)};
}

Memory ImplicitSurface::memory() const {
  Memory memory = stack_->memory();
  memory += field_.memory();
  memory += index_memory(versions_);
  memory += {0, heap_bytes(this), 0};
  return memory;
}

std::unique_ptr<RayCaster> ImplicitSurface::ray_caster() const { return field_ray_caster(*this); }

}  // namespace terrabench
