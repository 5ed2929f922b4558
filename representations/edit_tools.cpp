#include "representations/edit_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <string_view>

#include "representations/line_grid.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

struct Disc {
  double x, z, radius;
};

void check_radius(double radius) {
  if (!(radius > 0 && std::isfinite(radius))) {
    throw usage_error(fmt::format("a radius of {} m", radius), "edit tool",
                      "give a positive, finite number of metres");
  }
}

void check_position(std::string_view shape, glm::dvec3 at) {
  if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) {
    throw usage_error(fmt::format("{} at ({}, {}, {})", shape, at.x, at.y, at.z), "edit tool",
                      "give finite positions in metres");
  }
}

void check_reach(const Bounds& bounds, const Disc& disc, double bottom, double top) {
  const double dx = disc.x - std::clamp<double>(disc.x, bounds.low.x, bounds.high.x),
               dz = disc.z - std::clamp<double>(disc.z, bounds.low.z, bounds.high.z);
  if (std::hypot(dx, dz) < disc.radius && bottom < bounds.high.y && top > bounds.low.y) return;
  throw usage_error(fmt::format("the shape around ({}, {}) m, from {} to {} m, lies outside the terrain",
                                disc.x, disc.z, bottom, top),
                    "edit tool",
                    fmt::format("the terrain reaches from ({}, {}, {}) to ({}, {}, {}) m", bounds.low.x,
                                bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z));
}

// Indices of the lines that lie within `radius` of `centre` along one axis.
LevelRange within(double origin, double cell, int count, double centre, double radius) {
  const auto index = [&](double at) {
    return static_cast<int>(std::clamp(std::floor((at - origin) / cell + 1), 0.0, 1.0 * count));
  };
  return {index(centre - radius), index(centre + radius)};
}

LineGrid edited_lines(const Representation& edited) {
  if (const std::optional<LineGrid> lines = edited.edited_lines()) return *lines;
  throw usage_error("this representation cannot be edited", "edit tool",
                    "`terrabench list representations` names those that can");
}

// Edits each column whose axis lies within the disc with the span that span_at(plan, distance²) gives.
template <class SpanAt>
std::size_t edit_disc(Representation& edited, const Disc& disc, const SpanAt& span_at) {
  const LineGrid grid = edited_lines(edited);
  const LevelRange columns = within(grid.origin_x, grid.cell_x, grid.width, disc.x, disc.radius),
                   rows = within(grid.origin_z, grid.cell_z, grid.depth, disc.z, disc.radius);
  std::vector<float> x, z;
  std::vector<Span> spans;
  for (int j = rows.begin; j < rows.end; ++j) {
    for (int i = columns.begin; i < columns.end; ++i) {
      const double dx = grid.x(i) - disc.x, dz = grid.z(j) - disc.z;
      const double squared = dx * dx + dz * dz;
      if (!(squared < disc.radius * disc.radius)) continue;
      const Span span = span_at(glm::dvec2(grid.x(i), grid.z(j)), squared);
      if (!(span.bottom < span.top)) continue;  // empty, or thinner than floats tell apart
      x.push_back(grid.x(i));
      z.push_back(grid.z(j));
      spans.push_back(span);
    }
  }
  edited.edit({x, z}, spans);
  return spans.size();
}

}  // namespace

std::size_t fill_sphere(Representation& edited, const Sphere& sphere, Material material) {
  edited_lines(edited);
  const glm::vec3 c = sphere.centre;
  check_radius(sphere.radius);
  check_position("a sphere", glm::dvec3(c));
  const double y = c.y, radius = sphere.radius;
  const Disc disc{c.x, c.z, radius};
  check_reach(edited.bounds(), disc, y - radius, y + radius);
  return edit_disc(edited, disc, [&](glm::dvec2, double squared) {
    const double half = std::sqrt(radius * radius - squared);
    return Span{static_cast<float>(y - half), static_cast<float>(y + half), material};
  });
}

std::size_t erode(Representation& edited, const events::RadialErosion& event) {
  edited_lines(edited);
  for (const double radius : {event.radii.x, event.radii.y, event.radii.z}) check_radius(radius);
  const glm::dvec3 c = event.centre;
  check_position("an event", c);
  const Disc disc{c.x, c.z, std::max(event.radii.x, event.radii.z)};
  const Bounds bounds = edited.bounds();
  check_reach(bounds, disc, c.y - event.radii.y, HUGE_VAL);
  return edit_disc(edited, disc, [&](glm::dvec2 plan, double) {
    const double bottom = event.bottom(plan);
    if (bottom == HUGE_VAL) return Span{HUGE_VALF, HUGE_VALF, Material::kAir};  // outside the ellipse
    // Clamped to the terrain's heights, since a double may exceed all floats.
    return Span{static_cast<float>(std::clamp<double>(bottom, bounds.low.y, bounds.high.y)), HUGE_VALF,
                Material::kAir};
  });
}

}  // namespace terrabench
