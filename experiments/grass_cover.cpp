#include "experiments/grass_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace terrabench {
namespace {

const std::array kSpecs{
    ParameterSpec{"grass", 0.0, "1/m²", "strands of grass on the near meshes; 0: none", 0, 1000},
    ParameterSpec{"grass_height", 0.5, "m", "mean height of strands", 0.001, 100},
    ParameterSpec{"grass_width", 0.35, "m", "mean width of a strand's billboards", 0.001, 100},
    ParameterSpec{"grass_wind", 0.15, "m", "motion of the tip of a strand of 1 m", 0, 10},
};

struct Corners {
  glm::vec3 a, b, c;
  glm::vec3 cross() const { return glm::cross(b - a, c - a); }
  glm::vec3 middle() const { return (a + b + c) / 3.0F; }
};

Corners corners(const FrameMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t corner) { return mesh.positions[mesh.indices[3 * triangle + corner]]; };
  return {at(0), at(1), at(2)};
}

}  // namespace

std::span<const ParameterSpec> grass_parameters() { return kSpecs; }

GrassCover::GrassCover(const Parameters& p, const LandscapeStyle& style)
    : style_(style), density_(p.number("grass")), wind_(static_cast<float>(p.number("grass_wind"))) {
  growth_.height = static_cast<float>(p.number("grass_height"));
  growth_.width = static_cast<float>(p.number("grass_width"));
  growth_.steepest = style.steep;
  growth_.slope = style.slope_as_printed ? SlopeAngle::kPrinted : SlopeAngle::kTrue;
  growth_.by_area = growth_.turned = true;
}

GrassPatch GrassCover::grow(const FrameMesh& mesh, std::int64_t most) const {
  const float low =
      style_.has_water ? std::max(style_.water_level, style_.band_tops[0]) : style_.band_tops[0];
  const float high = style_.band_tops[1];
  std::vector<std::uint32_t> indices;
  double area = 0;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Corners at = corners(mesh, t);
    const glm::vec3 cross = at.cross();
    const float twice_area = glm::length(cross), height = at.middle().y;
    if (!(twice_area > 0) || height < low || height > high) continue;
    if (slope_angle(cross.y / twice_area, growth_.slope) > growth_.steepest) continue;
    area += 0.5 * twice_area;
    indices.insert(indices.end(), {mesh.indices[3 * t], mesh.indices[3 * t + 1], mesh.indices[3 * t + 2]});
  }
  GrassGrowth growth = growth_;
  growth.strands =
      static_cast<std::int64_t>(std::llround(std::min(density_ * area, static_cast<double>(most))));
  return {{mesh.positions, mesh.normals, indices}, growth};
}

void GrassCover::update(const Frame& frame, const View& view) {
  if (density_ == 0) return;
  std::map<std::uint64_t, GrassPatch> patches;
  glm::vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const FrameMesh& mesh : frame.meshes) {
    for (const glm::vec3 p : mesh.positions) {
      low = glm::min(low, {p.x, p.z});
      high = glm::max(high, {p.x, p.z});
    }
    if (auto known = patches_.extract(mesh.id)) {
      patches.insert(std::move(known));
    } else {
      const auto meshes = static_cast<std::int64_t>(frame.meshes.size());
      patches.emplace(mesh.id, grow(mesh, std::min(kMostStrands / meshes, GrassGrowth::kMostStrands)));
    }
  }
  patches_ = std::move(patches);
  const glm::vec2 eye(view.eye.x, view.eye.z), beyond = glm::max(eye - low, high - eye);
  reach_ = patches_.empty() ? 0 : std::max(beyond.x, beyond.y);
}

void GrassCover::draw(const PassView& pass) {
  if (reach_ <= 0 || (pass.pass != Pass::kPicture && pass.pass != Pass::kReflection)) return;
  GrassLook look{.world_to_clip = pass.world_to_clip, .eye = pass.eye, .sun = style_.sun};
  look.sun_colour = style_.sun_light;
  look.sky_colour = style_.sky_light;
  look.fog_colour = look.fog_sun_colour = style_.fog_color;
  // The landscape's fog grows with the square of the distance; this one equals it where the grass ends.
  look.fog_density = reach_ / (style_.fog_distance * style_.fog_distance);
  if (pass.pass == Pass::kReflection) look.clip_plane = pass.clip_plane;
  look.wind = glm::vec2(wind_, 0.4F * wind_);
  look.seconds = static_cast<float>(pass.seconds);
  look.thin_from = 0.4F * reach_;
  look.none_beyond = reach_;
  look.linear = has_colors(pass.pass) && pass.pass != Pass::kPicture;
  std::vector<GrassPatch*> all;
  for (auto& [id, patch] : patches_) all.push_back(&patch);
  renderer_.draw(all, look, GrassTechnique::kIndirect);
}

std::int64_t GrassCover::strands() const {
  std::int64_t all = 0;
  for (const auto& [id, patch] : patches_) all += patch.strands();
  return all;
}

}  // namespace terrabench
