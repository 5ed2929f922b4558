// The ray tracer's light against values that follow from geometry.
#include <gtest/gtest.h>

#include <random>

#include "tests/renderers/raytrace_scenes.h"

namespace terrabench {
namespace {

using namespace testing;

constexpr float kPi = glm::pi<float>();

// A convex body under a uniform sky of radiance 1 reflects its albedo, from every place and at any number of
// bounces; with its own normals, some directions are below the facets.
TEST(Raytrace, AConvexBodyInAUniformSkyHasItsAlbedo) {
  TriangleMesh faceted = sphere(24);
  faceted.normals.clear();
  for (const int bounces : {0, 3}) {
    RayScene scene;
    scene.light = uniform(1);
    scene.add_placed({.mesh = &faceted, .material = {.albedo = {0.7F, 0.4F, 0.1F}}});
    const auto picture =
        traced(scene, view({0, 0, 3}, {0, 0, 0}, 32, 32), {.samples = 4, .bounces = bounces});
    int seen = 0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        if (std::hypot(x - 15.5F, y - 15.5F) > 11) continue;
        ++seen;
        const glm::vec3 value = picture.radiance(x, y);
        ASSERT_NEAR(value.x, 0.7F, 1e-5F);
        ASSERT_NEAR(value.y, 0.4F, 1e-5F);
        ASSERT_NEAR(value.z, 0.1F, 1e-5F);
      }
    }
    EXPECT_GT(seen, 300);
  }
}

TEST(Raytrace, ASphereInTheSunIsShadedByLambertsLaw) {
  const TriangleMesh ball = sphere(150);
  RayScene scene;
  const glm::vec3 sun = glm::normalize(glm::vec3(0.5F, 0.6F, 0.7F));
  scene.light = sun_only(sun);
  scene.add_placed({.mesh = &ball, .material = {.albedo = glm::vec3(0.8F)}});
  const View v = view({0, 0, 4}, {0, 0, 0}, 101, 101, 0.6F);
  const auto picture = traced(scene, v, {.samples = 16, .bounces = 0});
  const RayCamera camera(v);
  int lit = 0;
  for (const auto& [x, y] : {std::pair{50, 50}, {60, 40}, {30, 30}, {70, 55}, {45, 75}, {20, 60}, {24, 76}}) {
    const Ray ray = camera.ray({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F});
    const float b = glm::dot(ray.origin, ray.direction), c = glm::dot(ray.origin, ray.origin) - 1;
    ASSERT_GT(b * b, c);
    const glm::vec3 normal = ray.origin + (-b - std::sqrt(b * b - c)) * ray.direction;
    const float expected = 0.8F * std::max(0.0F, glm::dot(normal, sun));
    EXPECT_NEAR(picture.radiance(x, y).x, expected, 0.004F) << x << " " << y;
    lit += expected > 0 ? 1 : 0;
  }
  EXPECT_GE(lit, 4);
  EXPECT_LT(lit, 7);  // some of the places are on the dark side
}

// Level ground east of a wall of height 2 at x = 0, with the sun in the west at the slope `rise`, seen from
// above: one pixel per 0.05 m of x, starting at x = 0.
std::vector<float> shadow_of_a_wall(float rise, float radius) {
  const TriangleMesh ground = quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}),
                     wall = quad({0, 0, -50}, {0, 0, 100}, {0, 2, 0});
  RayScene scene;
  scene.light = sun_only({-1, rise, 0}, radius);
  scene.add_placed({.mesh = &ground, .material = {.albedo = glm::vec3(1)}});
  scene.add_placed({.mesh = &wall});
  constexpr int kPixels = 200;
  const float up = 100;
  const View v = view({5, up, 0}, {5, 0, 0}, kPixels, 4, 2 * std::atan(0.1F / up));
  const auto picture = traced(scene, v, {.samples = 256, .bounces = 0});
  const float unshaded = std::sin(std::atan(rise));
  std::vector<float> lit;
  for (int x = 0; x < kPixels; ++x) lit.push_back(picture.radiance(x, 2).x / unshaded);
  return lit;
}

TEST(Raytrace, AShadowEndsWhereItsRayMeetsTheGround) {
  for (const float rise : {0.5F, 1.0F}) {
    const std::vector<float> lit = shadow_of_a_wall(rise, 0);
    const float edge = 2 / rise / 0.05F;  // in pixels
    for (int x = 0; x < 200; ++x) {
      const float right = static_cast<float>(x) + 1;
      if (right < edge - 0.05F && x > 0) {
        ASSERT_EQ(lit[x], 0) << rise << " " << x;
      }
      if (right > edge + 1.05F) {
        ASSERT_NEAR(lit[x], 1, 1e-4F) << rise << " " << x;
      }
    }
  }
}

// The part of the sun's disc above the wall, as seen from each place.
TEST(Raytrace, APenumbraFollowsThePartOfTheSunThatIsSeen) {
  const float radius = 0.1F, middle = std::atan(1.0F);
  const std::vector<float> lit = shadow_of_a_wall(1, radius);
  int partly = 0;
  for (int x = 20; x < 100; ++x) {
    const float place = (static_cast<float>(x) + 0.5F) * 0.05F;
    const float d = std::clamp(std::tan(std::atan(2 / place) - middle) / std::tan(radius), -1.0F, 1.0F);
    const float seen = (std::acos(d) - d * std::sqrt(1 - d * d)) / kPi;
    partly += seen > 0.1F && seen < 0.9F ? 1 : 0;
    ASSERT_NEAR(lit[x], seen, 0.035F) << x;
  }
  EXPECT_GT(partly, 5);
}

TEST(Raytrace, ALeafLitFromBehindShowsWhatPassesThrough) {
  const TriangleMesh leaf = quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  RayScene scene;
  scene.light = sun_only({0, 1, 1});
  scene.add_placed({.mesh = &leaf, .material = {.albedo = {0.2F, 0.8F, 0.1F}, .translucency = 0.25F}});
  const float cosine = std::sqrt(0.5F);
  const auto below = traced(scene, view({0, -3, 0}, {0, 0, 0}, 1, 1, 0.1F), {.samples = 16});
  const auto above = traced(scene, view({0, 3, 0}, {0, 0, 0}, 1, 1, 0.1F), {.samples = 16});
  EXPECT_NEAR(below.radiance(0, 0).y, 0.8F * 0.25F * cosine, 1e-5F);
  EXPECT_NEAR(above.radiance(0, 0).y, 0.8F * 0.75F * cosine, 1e-5F);
  scene.light = uniform(1);
  const auto furnace = traced(scene, view({0, -3, 0}, {0, 0, 0}, 1, 1, 0.1F), {.samples = 16});
  EXPECT_NEAR(furnace.radiance(0, 0).y, 0.8F, 1e-5F);
}

// The mean of sampled weights against the integral of toward() over evenly distributed directions.
TEST(Raytrace, SampledDirectionsGiveTheIntegralOfTheScattering) {
  const RayMaterial materials[] = {
      {.albedo = glm::vec3(0.6F), .specular = 0.04F, .roughness = 0.6F},
      {.albedo = glm::vec3(0.6F), .translucency = 0.4F, .specular = 0.5F, .roughness = 0.8F},
      {.albedo = {0.9F, 0.6F, 0.3F}, .metal = 1, .roughness = 0.7F},
      {.albedo = glm::vec3(0.5F), .specular = 0.1F, .metal = 0.5F, .roughness = 1},
  };
  const glm::vec3 up{0, 0, 1};
  std::mt19937 random(5);
  std::uniform_real_distribution<float> in(0, 1);
  for (const RayMaterial& material : materials) {
    for (const float tilt : {0.0F, 0.9F}) {
      const Scattering scattering(material, up, up, {std::sin(tilt), 0, std::cos(tilt)});
      glm::dvec3 sampled(0), integral(0);
      constexpr int kSamples = 50000;
      for (int k = 0; k < kSamples; ++k) {
        glm::vec3 direction, weight;
        if (scattering.sample(in(random), {in(random), in(random)}, direction, weight)) sampled += weight;
        const float z = 2 * in(random)-1, turn = 2 * kPi * in(random), r = std::sqrt(1 - z * z);
        integral += 4 * kPi * scattering.toward({r * std::cos(turn), r * std::sin(turn), z});
      }
      sampled /= kSamples;
      integral /= kSamples;
      EXPECT_NEAR(sampled.x, integral.x, 0.015) << material.roughness << " " << tilt;
      EXPECT_LE(sampled.x, 1.001);
      EXPECT_GT(sampled.x, 0.15);
    }
  }
}

}  // namespace
}  // namespace terrabench
