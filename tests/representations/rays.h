// Rays in tests, and every triangle of a mesh in turn as their truth, in double precision.
#pragma once

#include <glm/geometric.hpp>

#include "representations/ray_cast.h"
#include "tests/representations/ground.h"

namespace terrabench::test {

inline constexpr float kNoHit = std::numeric_limits<float>::infinity();

// Möller & Trumbore 1997, both sides.
inline double distance_to(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Ray& ray) {
  const glm::dvec3 o(ray.origin), d(ray.direction), ab = b - a, ac = c - a, p = glm::cross(d, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0) return kNoHit;
  const glm::dvec3 s = o - a, q = glm::cross(s, ab);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(d, q) / determinant;
  const double t = glm::dot(ac, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= ray.near && t <= ray.far ? t : kNoHit;
}

inline float brute_force(const TriangleMesh& mesh, const Ray& ray) {
  double nearest = kNoHit;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[t + k]]); };
    nearest = std::min(nearest, distance_to(corner(0), corner(1), corner(2), ray));
  }
  return static_cast<float>(nearest);
}

// From places in and around the bounds, in all directions; a part starts later or ends early.
inline std::vector<Ray> random_rays(const Bounds& bounds, unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::normal_distribution<float> normal;
  std::vector<Ray> rays;
  for (int r = 0; r < count; ++r) {
    const glm::vec3 share = glm::vec3(unit(random), unit(random), unit(random)) * 1.6F - 0.3F;
    Ray ray{bounds.low + share * bounds.size(), {normal(random), normal(random), normal(random)}};
    ray.direction *= glm::length(bounds.size()) / 3;
    if (r % 4 == 1) ray.direction.y *= 0.01F;  // grazing
    if (r % 8 == 2) ray.far = unit(random);
    if (r % 8 == 3) ray.near = unit(random);
    rays.push_back(ray);
  }
  return rays;
}

inline std::vector<float> cast(const Representation& on, std::span<const Ray> rays) {
  std::vector<float> distances(rays.size());
  const auto caster = on.ray_caster();
  EXPECT_NE(caster, nullptr);
  if (caster) caster->closest(rays, distances);
  return distances;
}

inline void expect_hit(float distance, float expected, std::size_t ray) {
  if (std::isfinite(expected)) {
    EXPECT_NEAR(distance, expected, 2e-5F * std::max(1.0F, expected)) << "ray " << ray;
  } else {
    EXPECT_EQ(distance, kNoHit) << "ray " << ray;
  }
}

// Compares with the triangles; at least an eighth of the rays must hit.
inline void expect_hits(const Representation& on, const TriangleMesh& mesh, unsigned seed) {
  const std::vector<Ray> rays = random_rays(bounds_of(mesh), seed, 1000);
  const std::vector<float> distances = cast(on, rays);
  std::size_t hits = 0;
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const float expected = brute_force(mesh, rays[r]);
    hits += std::isfinite(expected);
    expect_hit(distances[r], expected, r);
  }
  EXPECT_GT(hits, rays.size() / 8);
}

}  // namespace terrabench::test
