#include "lod/lod.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "terrain/error.h"

namespace terrabench {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

double setting(const Knob& knob, double value) {
  if (std::isnan(value)) {
    throw usage_error("the setting is not a number", knob.name,
                      fmt::format("choose {} to {} {}", knob.finest, knob.coarsest, knob.unit));
  }
  const auto [low, high] = std::minmax(knob.finest, knob.coarsest);
  const double within = std::clamp(value, low, high);
  return knob.whole ? std::round(within) : within;
}

void check_view(const View& view) {
  if (!is_finite(view.eye)) throw usage_error("the eye is not at a place", "eye", "give three finite metres");
  if (!is_finite(view.target) || view.target == view.eye) {
    throw usage_error("the view looks nowhere", "target", "give a finite point other than the eye");
  }
  const glm::dvec3 sight = glm::normalize(glm::dvec3(view.target) - glm::dvec3(view.eye));
  if (!is_finite(view.up) || !(glm::length(glm::cross(sight, glm::normalize(glm::dvec3(view.up)))) > 1e-6)) {
    throw usage_error("the view has no upward", "up", "give a direction across the line of sight");
  }
  if (!(view.vertical_fov > 0 && view.vertical_fov < std::numbers::pi_v<float>)) {
    throw usage_error(fmt::format("a field of view of {} rad shows nothing", view.vertical_fov),
                      "vertical_fov", "choose more than 0 and less than π");
  }
  if (view.width < 1 || view.height < 1) {
    throw usage_error(fmt::format("a screen of {} × {} has no pixels", view.width, view.height),
                      "width, height", "choose at least 1 × 1");
  }
  if (!(view.near > 0 && view.far > view.near && std::isfinite(view.far))) {
    throw usage_error(fmt::format("depths from {} to {} m show nothing", view.near, view.far), "near, far",
                      "choose 0 < near < far");
  }
}

void check_ground(const Heightfield& ground) {
  if (ground.width < 2 || ground.depth < 2) {
    throw usage_error(fmt::format("ground of {} × {} samples has no triangles", ground.width, ground.depth),
                      "", "level of detail needs at least 2 × 2 samples");
  }
  if (height_range(ground).no_data > 0) {
    throw usage_error("the ground has holes", "", "fill them first (fill_no_data)");
  }
}

GroundGrid grid_of(const Heightfield& field) {
  return {field.width, field.depth, field.cell_x, field.cell_z, field.heights};
}

}  // namespace terrabench
