#include "representations/representation.h"

#include <algorithm>
#include <cmath>

#include "representations/coding/column_codec.h"
#include "representations/column_grid.h"
#include "representations/edit_tools.h"
#include "representations/layered_stack/thermal_erosion.h"
#include "representations/line_grid.h"
#include "representations/procedural_mesh/face_mesh.h"
#include "representations/ray_cast.h"
#include "terrain/error.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

// Through the middles of nearly square cells.
LineGrid lines_over(const Bounds& bounds) {
  const glm::dvec3 size = bounds.size();
  const double cell = std::max({size.x, size.z, 1e-6}) / kDefaultResolution;
  LineGrid lines;
  lines.width = std::max(1, static_cast<int>(std::lround(size.x / cell)));
  lines.depth = std::max(1, static_cast<int>(std::lround(size.z / cell)));
  lines.cell_x = size.x > 0 ? size.x / lines.width : cell;
  lines.cell_z = size.z > 0 ? size.z / lines.depth : cell;
  lines.origin_x = bounds.low.x + 0.5 * lines.cell_x;
  lines.origin_z = bounds.low.z + 0.5 * lines.cell_z;
  return lines;
}

}  // namespace

bool Representation::encode(double, ByteSink& out) const {
  const ColumnGrid* const columns = column_grid();
  if (columns == nullptr) return false;
  encode_columns(*columns, columns_of(*this, *columns), out);
  return true;
}

void Representation::materials(Points where, std::span<Material> out) const {
  SpanSink sink;
  spans({where.x, where.z}, sink);
  for (std::size_t i = 0; i < where.size(); ++i) {
    const float y = where.y[i];
    const std::span<const Span> column = sink.column(i);
    const auto above =
        std::find_if(column.begin(), column.end(), [&](const Span& span) { return y < span.top; });
    out[i] = above != column.end() && above->bottom <= y ? above->material : Material::kAir;
  }
}

void Representation::edit(Columns, std::span<const Span>) {
  throw usage_error("this representation cannot be edited", "edit",
                    "choose an editable representation: see `terrabench list representations`");
}

void Representation::apply(const events::Event& event) {
  const auto* const erosion = std::get_if<events::RadialErosion>(&event);
  if (erosion == nullptr || !edited_lines()) {
    throw usage_error(
        "this representation does not take this event", "event",
        "a grounded heightmap tree takes all events; what can be edited takes a radial erosion");
  }
  erode(*this, *erosion);
}

ThermalErosion Representation::erode_to(double, Progress&) {
  throw usage_error("this representation cannot be eroded", "erosion",
                    "choose one with the trait erodes: see `terrabench list representations --json`");
}

std::optional<LineGrid> Representation::edited_lines() const {
  const ColumnGrid* const columns = column_grid();
  return columns != nullptr ? std::optional(lines_of(*columns)) : std::nullopt;
}

LineGrid Representation::lines() const {
  const std::optional<LineGrid> edited = edited_lines();
  return edited ? *edited : lines_over(bounds());
}

std::unique_ptr<RayCaster> Representation::ray_caster() const {
  const ColumnGrid* const columns = column_grid();
  return columns != nullptr ? span_ray_caster(*this, *columns) : nullptr;
}

FaceMesh Representation::polygons() const {
  TriangleMesh triangles = mesh({});
  FaceMesh faces;
  faces.positions = std::move(triangles.positions);
  faces.corners = std::move(triangles.indices);
  faces.first_corner.reserve(faces.corners.size() / 3 + 1);
  for (std::size_t c = 0; c <= faces.corners.size(); c += 3)
    faces.first_corner.push_back(static_cast<std::uint32_t>(c));
  return faces;
}

std::int64_t destroy_and_count(std::unique_ptr<Representation> structure) {
  const std::int64_t before = HeapCounter::live();
  structure.reset();
  return before - HeapCounter::live();
}

}  // namespace terrabench
