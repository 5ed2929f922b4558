// Shapes with known answers, for the ray tracer's tests.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "renderers/raytrace/raytraced_picture.h"
#include "tests/renderers/ground.h"

namespace terrabench::testing {

// A quadrilateral from its corner along two edges.
inline TriangleMesh quad(glm::vec3 corner, glm::vec3 a, glm::vec3 b) {
  TriangleMesh mesh;
  mesh.positions = {corner, corner + a, corner + a + b, corner + b};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

inline TriangleMesh box(glm::vec3 low, glm::vec3 high) {
  const glm::vec3 s = high - low, x{s.x, 0, 0}, y{0, s.y, 0}, z{0, 0, s.z};
  TriangleMesh mesh = quad(low, x, z);
  append(mesh, quad(low + y, z, x));
  append(mesh, quad(low, y, x));
  append(mesh, quad(low + z, x, y));
  append(mesh, quad(low, z, y));
  append(mesh, quad(low + x, y, z));
  return mesh;
}

// Of radius 1 around the origin, with its exact normals.
inline TriangleMesh sphere(int n) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j) {
    const float down = glm::pi<float>() * static_cast<float>(j) / static_cast<float>(n);
    for (int i = 0; i <= 2 * n; ++i) {
      const float turn = glm::pi<float>() * static_cast<float>(i) / static_cast<float>(n);
      mesh.positions.emplace_back(std::sin(down) * std::cos(turn), std::cos(down),
                                  std::sin(down) * std::sin(turn));
    }
  }
  const auto row = static_cast<std::uint32_t>(2 * n + 1);
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(n); ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
    }
  }
  mesh.normals = mesh.positions;
  return mesh;
}

// Sky light of this radiance from everywhere, without a sun.
inline Daylight uniform(float radiance) {
  Daylight light;
  light.sun_irradiance = glm::vec3(0);
  light.sky = SkyKind::kUniform;
  light.zenith = glm::vec3(radiance);
  return light;
}

// A sun alone, of irradiance π.
inline Daylight sun_only(glm::vec3 towards, float radius = 0) {
  Daylight light = uniform(0);
  light.sun = towards;
  light.sun_irradiance = glm::vec3(glm::pi<float>());
  light.sun_radius = radius;
  return light;
}

inline View view(glm::vec3 eye, glm::vec3 target, int width, int height, float fov = 0.8F) {
  View v;
  v.eye = eye;
  v.target = target;
  const glm::vec3 along = glm::normalize(target - eye);
  if (std::abs(along.y) > 0.99F) v.up = {0, 0, -1};
  v.width = width;
  v.height = height;
  v.vertical_fov = fov;
  return v;
}

inline RaytracedPicture traced(const RayScene& scene, const View& v, RaytraceSettings settings) {
  RaytracedPicture picture(scene, v, settings);
  picture.accumulate();
  return picture;
}

}  // namespace terrabench::testing
