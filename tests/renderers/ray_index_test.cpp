// Ray queries against every triangle tried in turn; sky and samples on their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/renderers/raytrace_scenes.h"

namespace terrabench {
namespace {

using namespace testing;

TriangleMesh soup(int triangles, std::mt19937& random) {
  std::uniform_real_distribution<float> in(-1, 1);
  TriangleMesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const glm::vec3 middle(5 * in(random), 5 * in(random), 5 * in(random));
    for (int k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(middle + glm::vec3(in(random), in(random), in(random)));
    }
  }
  return mesh;
}

// The distance to a triangle, or infinity; in double (Möller & Trumbore 1997).
double distance_to(const TriangleMesh& mesh, std::size_t triangle, const Ray& ray) {
  const glm::dvec3 a = mesh.positions[mesh.indices[3 * triangle]],
                   b = mesh.positions[mesh.indices[3 * triangle + 1]],
                   c = mesh.positions[mesh.indices[3 * triangle + 2]];
  const glm::dvec3 across = glm::cross(glm::dvec3(ray.direction), c - a), from = glm::dvec3(ray.origin) - a;
  const double volume = glm::dot(b - a, across);
  const double u = glm::dot(from, across) / volume;
  const glm::dvec3 normal = glm::cross(from, b - a);
  const double v = glm::dot(glm::dvec3(ray.direction), normal) / volume;
  const double t = glm::dot(c - a, normal) / volume;
  const bool inside = u >= 0 && v >= 0 && u + v <= 1 && t >= ray.near && t <= ray.far;
  return inside ? t : std::numeric_limits<double>::infinity();
}

TEST(RayIndex, FindsWhatTryingEveryTriangleFinds) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> in(-1, 1);
  const TriangleMesh mesh = soup(500, random);
  const RayIndex index(mesh);
  std::vector<Ray> rays;
  for (int k = 0; k < 3000; ++k) {
    rays.push_back({.origin = {6 * in(random), 6 * in(random), 6 * in(random)},
                    .direction = {in(random), in(random), in(random)},
                    .near = k % 3 == 0 ? 2.0F : 0.0F,
                    .far = k % 5 == 0 ? 4.0F : std::numeric_limits<float>::infinity()});
  }
  std::vector<RayHit> hits(rays.size());
  index.closest(rays, hits);
  int found = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = RayHit::kNone;
    for (std::uint32_t t = 0; t < mesh.triangles(); ++t) {
      const double distance = distance_to(mesh, t, rays[k]);
      if (distance < nearest) {
        nearest = distance;
        triangle = t;
      }
    }
    ASSERT_EQ(hits[k].triangle, triangle) << k;
    ASSERT_EQ(hits[k].hit(), index.occluded(rays[k])) << k;
    if (!hits[k].hit()) continue;
    ++found;
    ASSERT_NEAR(hits[k].distance, nearest, 1e-4 * (1 + nearest));
    const std::uint32_t* const c = &mesh.indices[3 * std::size_t{triangle}];
    const glm::vec3 at = (1 - hits[k].u - hits[k].v) * mesh.positions[c[0]] +
                         hits[k].u * mesh.positions[c[1]] + hits[k].v * mesh.positions[c[2]];
    ASSERT_LT(glm::length(at - (rays[k].origin + hits[k].distance * rays[k].direction)), 1e-4F);
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(index.bytes(), mesh.triangles() * 20);
}

TEST(RayIndex, UnusableRaysHitNothing) {
  const TriangleMesh mesh = box({-1, -1, -1}, {1, 1, 1});
  const RayIndex index(mesh);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInfinite = std::numeric_limits<float>::infinity();
  for (const Ray& ray :
       {Ray{.origin = {kNan, 0, 0}, .direction = {1, 0, 0}}, Ray{.origin = {0, 0, 0}, .direction = {0, 0, 0}},
        Ray{.origin = {0, 0, 0}, .direction = {kInfinite, 0, 0}},
        Ray{.origin = {0, 0, 0}, .direction = {1, 0, 0}, .near = 2, .far = 1}}) {
    EXPECT_FALSE(index.closest(ray).hit());
    EXPECT_FALSE(index.occluded(ray));
  }
  EXPECT_TRUE(index.closest({.origin = {0, 0, 0}, .direction = {1, 0, 0}}).hit());
}

// Of each pair of dimensions, 16 samples lie in different cells of 4 × 4, 16 × 1 and 1 × 16.
TEST(SampleSequence, IsStratifiedInEveryPairOfDimensions) {
  for (const std::uint32_t pixel : {0U, 1U, 77777U}) {
    std::vector<std::set<int>> cells(3 * 6);
    for (std::uint32_t sample = 32; sample < 48; ++sample) {
      SampleSequence samples(pixel, sample, 1);
      for (std::size_t pair = 0; pair < 6; ++pair) {
        const glm::vec2 at = samples.next();
        ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1);
        cells[3 * pair].insert(static_cast<int>(at.x * 4) * 4 + static_cast<int>(at.y * 4));
        cells[3 * pair + 1].insert(static_cast<int>(at.x * 16));
        cells[3 * pair + 2].insert(static_cast<int>(at.y * 16));
      }
    }
    for (const auto& filled : cells) EXPECT_EQ(filled.size(), 16U);
  }
}

TEST(Sky, OfPreethamHasTheIrradianceAskedForAndIsBrightestAtTheSun) {
  for (const float turbidity : {2.0F, 3.0F, 6.0F, 10.0F}) {
    for (const float height : {-0.2F, 0.05F, 0.5F, 2.0F}) {
      Daylight light;
      light.sun = {1, height, 0.5F};
      light.turbidity = turbidity;
      light.sky_irradiance = 1.5F;
      const Sky sky(light);
      double sum = 0;
      std::mt19937 random(2);
      std::uniform_real_distribution<float> in(0, 1);
      constexpr int kSamples = 10000;
      for (int k = 0; k < kSamples; ++k) {  // uniformly over the hemisphere
        const float y = in(random), r = std::sqrt(1 - y * y), turn = 6.2831853F * in(random);
        const glm::vec3 c = sky.radiance({r * std::cos(turn), y, r * std::sin(turn)});
        ASSERT_TRUE(std::min({c.x, c.y, c.z}) >= 0 && std::isfinite(c.x + c.y + c.z));
        sum += 6.2831853 * y * (0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z);
      }
      EXPECT_NEAR(sum / kSamples, 1.5, 0.08) << turbidity << " " << height;
      if (height < 0) continue;
      const glm::vec3 s = glm::normalize(light.sun);
      EXPECT_GT(sky.radiance(s).y, 1.3F * sky.radiance({-s.x, s.y, -s.z}).y) << turbidity << " " << height;
    }
  }
}

TEST(Sky, TheSunIsWhiteAtTheZenithAndRedAtTheHorizon) {
  const glm::vec3 high = sun_color(3, 1), low = sun_color(3, 0.05F);
  EXPECT_GT(high.z, 0.7F);
  EXPECT_LT(low.z, 0.3F);
  EXPECT_EQ(low.x, 1);
}

}  // namespace
}  // namespace terrabench
