#include "renderers/raytrace/path_tracer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "terrain/error.h"

namespace terrabench {
namespace {

const RayScene& checked(const RayScene& scene, const RaytraceSettings& settings) {
  if (settings.samples < 1 || settings.samples > 65536) {
    throw usage_error(fmt::format("invalid number of samples {}", settings.samples), "ray tracing",
                      "it must be 1 to 65536");
  }
  if (settings.bounces < 0 || settings.bounces > 64) {
    throw usage_error(fmt::format("invalid number of bounces {}", settings.bounces), "ray tracing",
                      "it must be 0 to 64");
  }
  check_scene(scene);
  return scene;
}

RayIndex index_of(const RayScene& scene, Progress* progress) {
  std::vector<const TriangleMesh*> meshes;
  for (const RayMesh& mesh : scene.meshes) meshes.push_back(mesh.mesh);
  return {meshes, scene.instances, progress};
}

}  // namespace

PathTracer::PathTracer(const RayScene& scene, const RaytraceSettings& settings, Progress* progress)
    : scene_(checked(scene, settings)),
      settings_(settings),
      index_(index_of(scene, progress)),
      sky_(scene.light),
      sun_(scene.light) {}

PathTracer::Surface PathTracer::surface(const Ray& ray, const RayHit& hit) const {
  const MeshPlacement& placement = scene_.instances[hit.placement];
  const TriangleMesh& mesh = *scene_.meshes[placement.mesh].mesh;
  const std::uint32_t* const corners = &mesh.indices[3 * std::size_t{hit.triangle}];
  const glm::vec3 a = mesh.positions[corners[0]];
  const glm::vec3 ab = mesh.positions[corners[1]] - a, ac = mesh.positions[corners[2]] - a;
  Surface s;
  s.point.mesh = placement.mesh;
  s.point.instance = hit.placement;
  s.point.triangle = hit.triangle;
  s.point.local = s.point.position = a + hit.u * ab + hit.v * ac;
  s.facet = glm::cross(ab, ac);
  s.normal = mesh.normals.empty() ? s.facet : hit.interpolate<glm::vec3>(mesh.normals, corners);
  if (placement.to_world != glm::mat4(1)) {
    const glm::mat3 linear(placement.to_world);
    // Scaled first: the product of two edges of a small triangle is close to float's limits.
    const glm::mat3 of_normals = glm::transpose(glm::inverse(linear));
    s.point.position = glm::vec3(placement.to_world * glm::vec4(s.point.local, 1));
    s.facet = of_normals * unit_or(s.facet, {0, 1, 0});
    s.normal = of_normals * s.normal;
  }
  s.facet = unit_or(s.facet, -ray.direction);
  s.normal = unit_or(s.normal, s.facet);
  s.point.normal = s.normal;
  if (glm::dot(s.facet, ray.direction) > 0) s.facet = -s.facet;
  if (glm::dot(s.normal, s.facet) < 0) s.normal = -s.normal;
  // Rounding of the intersection grows with the coordinates of the triangle, in its own mesh and in the
  // world.
  const glm::vec3 own = glm::max(glm::abs(a), glm::max(glm::abs(ab), glm::abs(ac)));
  const glm::vec3 world = glm::max(glm::abs(s.point.position), glm::abs(glm::vec3(placement.to_world[3])));
  const glm::mat3 linear(placement.to_world);
  const float scale = std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
  s.offset = kRayOffset * std::max({world.x, world.y, world.z, scale * own.x, scale * own.y, scale * own.z});
  return s;
}

RayMaterial PathTracer::material(const Surface& s, const RayHit& hit) const {
  const RayMesh& mesh = scene_.meshes[s.point.mesh];
  const std::uint32_t* const corners = &mesh.mesh->indices[3 * std::size_t{hit.triangle}];
  if (!mesh.material_at) return mesh.material;
  SurfacePoint point = s.point;
  if (!mesh.texture.empty()) point.texture = hit.interpolate(mesh.texture, corners);
  return mesh.material_at(point);
}

Ray PathTracer::ray_from(const Surface& s, const glm::vec3& direction) const {
  const float side = glm::dot(direction, s.facet) > 0 ? s.offset : -s.offset;
  return {.origin = s.point.position + side * s.facet, .direction = direction};
}

glm::vec3 PathTracer::sunlight(const Surface& s, const Scattering& scattering,
                               SampleSequence& samples) const {
  if (!sun_.shines()) return glm::vec3(0);
  const glm::vec3 to_sun = sun_.direction(samples.next());
  const glm::vec3 light = scene_.light.sun_irradiance * scattering.toward(to_sun);
  return light == glm::vec3(0) || index_.occluded(ray_from(s, to_sun)) ? glm::vec3(0) : light;
}

glm::vec3 PathTracer::radiance(const Ray& from_eye, const RayHit& first, SampleSequence& samples) const {
  if (!first.hit()) return sky_.radiance(from_eye.direction) + sun_.radiance(from_eye.direction);
  glm::vec3 light(0), weight(1);
  Ray ray = from_eye;
  RayHit hit = first;
  for (int bounce = 0;; ++bounce) {
    const Surface s = surface(ray, hit);
    RayMaterial made_of = material(s, hit);
    if (bounce > 0) made_of.roughness = std::max(made_of.roughness, kIndirectRoughness);
    const Scattering scattering(made_of, s.facet, s.normal, -ray.direction);
    light += weight * sunlight(s, scattering, samples);
    glm::vec3 direction, part;
    const float lobe = scattering.has_lobes() ? samples.next().x : 0;
    if (!scattering.sample(lobe, samples.next(), direction, part)) return light;
    weight *= part;
    ray = ray_from(s, direction);
    if (bounce == settings_.bounces) {  // only the sky is left to be found
      return index_.occluded(ray) ? light : light + weight * sky_.radiance(direction);
    }
    hit = index_.closest(ray);
    if (!hit.hit()) return light + weight * sky_.radiance(direction);
  }
}

}  // namespace terrabench
