#include "viewer/pick.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/meters/projector.h"

namespace terrabench::viewer {
namespace {

// The part of the ray over the ground's plan, in lengths of `sight`; empty: from > to.
struct Part {
  double from = 0, to = std::numeric_limits<double>::infinity();
};

Part over(const Heightfield& ground, const glm::dvec3& eye, const glm::dvec3& sight) {
  Part part;
  const double sides[] = {static_cast<double>(ground.extent_x()), static_cast<double>(ground.extent_z())};
  for (int side = 0; side < 2; ++side) {
    const double at = eye[2 * side], way = sight[2 * side];
    if (way == 0) {
      if (at < 0 || at > sides[side]) return {1, 0};
      continue;
    }
    const auto [near, far] = std::minmax({-at / way, (sides[side] - at) / way});
    part = {std::max(part.from, near), std::min(part.to, far)};
  }
  return part;
}

}  // namespace

std::optional<glm::dvec3> pick(const Heightfield& ground, const glm::dvec3& eye, const glm::dvec3& sight) {
  const auto above = [&](double t) {
    const glm::dvec3 at = eye + t * sight;
    const float x = std::clamp(static_cast<float>(at.x), 0.0F, ground.extent_x());
    const float z = std::clamp(static_cast<float>(at.z), 0.0F, ground.extent_z());
    return at.y - static_cast<double>(ground.sample(x, z));
  };
  const double in_plan = std::hypot(sight.x, sight.z);
  Part part = over(ground, eye, sight);
  // A vertical ray crosses the surface at its own height over it.
  if (in_plan == 0) {
    if (part.from > part.to || sight.y >= 0 || above(0) < 0) return std::nullopt;
    return eye + sight * (above(0) / -sight.y);
  }
  if (part.from > part.to || above(part.from) < 0) return std::nullopt;
  const double step = 0.5 * static_cast<double>(std::min(ground.cell_x, ground.cell_z)) / in_plan;
  for (double t = part.from; t < part.to; t += step) {
    double low = t, high = std::min(t + step, part.to);
    if (above(high) > 0) continue;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (above(middle) > 0 ? low : high) = middle;
    }
    return eye + high * sight;
  }
  return std::nullopt;
}

std::optional<glm::dvec3> pick(const Heightfield& ground, const View& view, const glm::dvec2& pixel) {
  return pick(ground, glm::dvec3(view.eye), Projector(view).direction(pixel.x, pixel.y));
}

}  // namespace terrabench::viewer
