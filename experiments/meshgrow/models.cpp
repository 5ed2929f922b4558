#include "experiments/meshgrow/models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "representations/procedural_mesh/growing/expression.h"
#include "terrain/error.h"

namespace terrabench::meshgrow {
namespace {

float noise(const glm::vec3& p) { return static_cast<float>(growing::gradient_noise(p.x, p.y, p.z)); }

// Several octaves, about -1 to 1.
float rough_noise(glm::vec3 p) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < 4; ++octave, p *= 2.03F, weight *= 0.5F) sum += weight * noise(p);
  return sum;
}

RayMaterial chair(std::string_view symbol, const SurfacePoint& at) {
  const glm::vec3& p = at.local;
  if (symbol == "cloth" || symbol == "cushion") {
    const float dye = 1 + 0.12F * rough_noise(14.0F * p);
    return {.albedo = dye * glm::vec3(0.42F, 0.06F, 0.05F), .roughness = 1};
  }
  // Rings of a trunk that lies along z, bent by noise.
  const float distance = glm::length(glm::vec2(p.x + 0.9F, p.y - 1.6F)) + 0.03F * noise(3.0F * p);
  const float ring = 0.5F + 0.5F * std::sin(95 * distance + 2 * noise({4 * p.x, 4 * p.y, p.z}));
  const glm::vec3 wood = glm::mix(glm::vec3(0.36F, 0.19F, 0.08F), glm::vec3(0.24F, 0.11F, 0.045F), ring);
  return {.albedo = wood, .specular = 0.04F, .roughness = 0.35F};
}

RayMaterial cactus(std::string_view symbol, const SurfacePoint& at) {
  if (symbol == "spike") return {.albedo = {0.72F, 0.6F, 0.34F}, .roughness = 0.6F};
  // Lighter along the ribs, which follow u.
  const float rib = 0.5F + 0.5F * std::cos(8 * std::numbers::pi_v<float> * at.texture.x);
  const glm::vec3 green = glm::mix(glm::vec3(0.05F, 0.16F, 0.05F), glm::vec3(0.15F, 0.33F, 0.1F), rib);
  return {.albedo = (1 + 0.15F * rough_noise(6.0F * at.local)) * green, .specular = 0.03F, .roughness = 0.5F};
}

RayMaterial fork(std::string_view, const SurfacePoint& at) {
  // Dark in the grooves between the ridges of cos(360° · 8u), and spotted.
  const float ridge = 0.5F + 0.5F * std::cos(16 * std::numbers::pi_v<float> * at.texture.x);
  const float spots = 1 + 0.35F * rough_noise(9.0F * at.local * glm::vec3(1, 0.4F, 1));
  const glm::vec3 bark = glm::mix(glm::vec3(0.13F, 0.085F, 0.055F), glm::vec3(0.36F, 0.27F, 0.19F), ridge);
  return {.albedo = glm::clamp(spots * bark, 0.0F, 1.0F), .roughness = 1};
}

bool is_leaf(std::string_view symbol) { return symbol == "green"; }

RayMaterial leaf(const SurfacePoint& at, const glm::vec3& dark, const glm::vec3& light) {
  const float mix = std::clamp(0.5F + 0.9F * noise(2.3F * at.local), 0.0F, 1.0F);
  return {.albedo = glm::mix(dark, light, mix), .translucency = 0.35F, .specular = 0.03F, .roughness = 0.5F};
}

RayMaterial aspen(std::string_view symbol, const SurfacePoint& at) {
  if (is_leaf(symbol)) return leaf(at, {0.12F, 0.3F, 0.05F}, {0.3F, 0.46F, 0.09F});
  const float spots = std::clamp(0.6F + rough_noise(glm::vec3(9, 40, 9) * at.local), 0.0F, 1.0F);
  return {.albedo = glm::mix(glm::vec3(0.12F, 0.1F, 0.08F), glm::vec3(0.46F, 0.42F, 0.35F), spots)};
}

RayMaterial tupelo(std::string_view symbol, const SurfacePoint& at) {
  if (is_leaf(symbol)) return leaf(at, {0.06F, 0.2F, 0.04F}, {0.2F, 0.38F, 0.08F});
  const float spots = std::clamp(0.5F + rough_noise(glm::vec3(20, 8, 20) * at.local), 0.0F, 1.0F);
  return {.albedo = glm::mix(glm::vec3(0.1F, 0.07F, 0.05F), glm::vec3(0.26F, 0.2F, 0.15F), spots)};
}

RayMaterial candle_holder(std::string_view symbol, const SurfacePoint& at) {
  if (symbol == "wax") return {.albedo = {0.82F, 0.77F, 0.62F}, .specular = 0.03F, .roughness = 0.4F};
  // Rust lies where the model's own noise eats pits, and in larger stains.
  const glm::vec3& p = at.local;
  const float pits = std::clamp(4 * noise(40.0F * p) - 0.6F, 0.0F, 1.0F);
  const float stains = std::clamp(1.6F * rough_noise(9.0F * p) + 0.1F, 0.0F, 1.0F);
  const float rust = std::max(pits, stains);
  const float hue = std::clamp(0.5F + rough_noise(70.0F * p), 0.0F, 1.0F);
  const glm::vec3 brown = glm::mix(glm::vec3(0.17F, 0.055F, 0.02F), glm::vec3(0.42F, 0.17F, 0.05F), hue);
  return {.albedo = glm::mix(glm::vec3(0.1F, 0.1F, 0.11F), brown, rust),
          .specular = 0.04F * (1 - rust),
          .metal = 0.7F * (1 - rust),
          .roughness = glm::mix(0.42F, 1.0F, rust)};
}

constexpr std::array kPainted{
    PaintedModel{"chair", chair},
    PaintedModel{"cactus", cactus},
    PaintedModel{"fork_ridges", fork},
    PaintedModel{"fork_ridges_random", fork},
    PaintedModel{"branch_aspen", aspen},
    PaintedModel{"bush_tupelo", tupelo},
    PaintedModel{"candle_holder", candle_holder},
};

}  // namespace

const PaintedModel& painted(std::string_view model) {
  std::vector<std::string_view> names;
  for (const PaintedModel& each : kPainted) {
    if (each.model == model) return each;
    names.push_back(each.model);
  }
  throw unknown_name("painted model", model, names);
}

ModelMesh triangles_of(const FaceMesh& faces) {
  ModelMesh out;
  out.mesh.positions = faces.positions;
  out.texture = faces.texture;
  for (std::size_t f = 0; f < faces.faces(); ++f) {
    const std::uint32_t* corner = &faces.corners[faces.first_corner[f]];
    const std::uint32_t n = faces.first_corner[f + 1] - faces.first_corner[f];
    const auto at = [&](std::uint32_t k) { return corner[k % n]; };
    const auto diagonal = [&](std::uint32_t k) {
      return glm::distance(faces.positions[at(k)], faces.positions[at(k + 2)]);
    };
    const std::uint32_t apex = n == 4 && diagonal(1) < diagonal(0) ? 1 : 0;
    for (std::uint32_t k = 1; k + 1 < n; ++k) {
      out.mesh.indices.insert(out.mesh.indices.end(), {at(apex), at(apex + k), at(apex + k + 1)});
      out.wires.push_back(static_cast<std::uint8_t>((k == 1 ? 1U : 0U) | 2U | (k + 2 == n ? 4U : 0U)));
      out.symbols.push_back(faces.symbols.empty() ? 0 : faces.symbols[f]);
    }
  }
  compute_normals(out.mesh);
  return out;
}

RayMesh in_materials(const ModelMesh& mesh, const PaintedModel& look, const growing::RuleSystem& system) {
  return {.mesh = &mesh.mesh,
          .texture = mesh.texture,
          .material_at = [&mesh, &look, &system](const SurfacePoint& at) {
            return look.material(system.symbols[mesh.symbols[at.triangle]].name, at);
          }};
}

Daylight model_daylight() {
  Daylight light;
  light.sun = {-0.75F, 0.85F, 0.6F};
  light.sun_irradiance = 3.6F * sun_color(light.turbidity, glm::normalize(light.sun).y);
  light.sun_radius = 0.035F;
  light.sky_irradiance = 1.2F;
  return light;
}

}  // namespace terrabench::meshgrow
