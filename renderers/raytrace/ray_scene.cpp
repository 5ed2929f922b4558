#include "renderers/raytrace/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "renderers/ramp.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

bool is_share(float x) { return x >= 0 && x <= 1; }
bool is_share(const glm::vec3& v) { return is_share(v.x) && is_share(v.y) && is_share(v.z); }
bool is_light(float x) { return x >= 0 && std::isfinite(x); }
bool is_light(const glm::vec3& v) { return is_light(v.x) && is_light(v.y) && is_light(v.z); }

void check_material(const RayMaterial& m, const std::string& where) {
  if (is_share(m.albedo) && is_share(m.translucency) && is_share(m.specular) && is_share(m.metal) &&
      is_share(m.roughness)) {
    return;
  }
  throw bad_input("a value of the material is out of range", where, "all must be 0 to 1");
}

void check_mesh(const RayMesh& m, std::size_t number) {
  const std::string where = fmt::format("mesh {}", number);
  if (m.mesh == nullptr) throw bad_input("there is no mesh", where, "set RayMesh::mesh");
  check_material(m.material, where);
  if (!m.texture.empty() && m.texture.size() != m.mesh->positions.size()) {
    throw bad_input(
        fmt::format("{} texture coordinates for {} positions", m.texture.size(), m.mesh->positions.size()),
        where, "give one for each, or none");
  }
  if (!m.wires.empty() && m.wires.size() != m.mesh->triangles()) {
    throw bad_input(fmt::format("{} wire masks for {} triangles", m.wires.size(), m.mesh->triangles()), where,
                    "give one for each, or none");
  }
  if (!is_light(m.wire_width) || !is_light(m.wire_color) || !is_share(m.wire_opacity)) {
    throw bad_input("the wires' width, colour or opacity is out of range", where,
                    "none may be negative, and opacity at most 1");
  }
}

constexpr glm::vec3 kRock{0.42F, 0.38F, 0.33F};
// The ramp's colours are for the picture's surface; as reflectances they would be brighter than any ground.
constexpr float kGroundShare = 0.8F;

}  // namespace

std::uint32_t RayScene::add(RayMesh mesh) {
  meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(meshes.size() - 1);
}

std::uint32_t RayScene::add_placed(RayMesh mesh) {
  const std::uint32_t number = add(std::move(mesh));
  instances.push_back({.mesh = number});
  return number;
}

void check_scene(const RayScene& scene) {
  check_daylight(scene.light);
  if (scene.background && !is_share(*scene.background)) {
    throw bad_input("the background's colour is out of range", "scene", "give three values of 0 to 1");
  }
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) check_mesh(scene.meshes[m], m);
}

TriangleMesh ground_plane(const Bounds& bounds, float times, std::optional<float> height) {
  const glm::vec3 middle = 0.5F * (bounds.low + bounds.high), size = bounds.size();
  const float half = 0.5F * times * std::max({size.x, size.z, 1e-3F}), y = height.value_or(bounds.low.y);
  TriangleMesh plane;
  plane.positions = {{middle.x - half, y, middle.z - half},
                     {middle.x - half, y, middle.z + half},
                     {middle.x + half, y, middle.z - half},
                     {middle.x + half, y, middle.z + half}};
  plane.normals.assign(4, {0, 1, 0});
  plane.indices = {0, 1, 2, 2, 1, 3};
  return plane;
}

RayScene relief_scene(const TriangleMesh& mesh, float lowest, float highest) {
  RayScene scene;
  scene.background = glm::vec3(1);
  // From the left and in front of overview()'s eye, so that one side of a block is lit and the other is not,
  // and low, so that shadows show the relief.
  scene.light.sun = glm::normalize(glm::vec3(-0.85F, 0.6F, 0.35F));
  scene.light.sun_irradiance = 4.6F * sun_color(scene.light.turbidity, scene.light.sun.y);
  scene.light.sky_irradiance = 1.1F;
  const float range = std::max(highest - lowest, 1e-6F);
  scene.add_placed({.mesh = &mesh, .material_at = [lowest, range](const SurfacePoint& p) {
                      const glm::vec3 ground = kGroundShare * ramp_color((p.position.y - lowest) / range);
                      const float level = glm::smoothstep(0.25F, 0.6F, std::abs(p.normal.y));
                      return RayMaterial{.albedo = glm::mix(kRock, ground, level)};
                    }});
  return scene;
}

}  // namespace terrabench
