// What a ray-traced picture promises whatever it shows, and how it refuses unusable input.
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/renderers/ground.h"
#include "tests/renderers/raytrace_scenes.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using namespace testing;

RayScene hilly(const TriangleMesh& ground, const TriangleMesh& ball) {
  RayScene scene;
  scene.add_placed({.mesh = &ground, .material = {.albedo = {0.5F, 0.45F, 0.3F}}});
  scene.add_placed({.mesh = &ground});  // at the same place: hits at equal distances
  const auto number = scene.add({.mesh = &ball, .material = {.specular = 0.04F, .roughness = 0.3F}});
  for (int k = 0; k < 9; ++k) {
    const glm::vec3 at(1000.0F * static_cast<float>(k % 3) + 4000, 1100,
                       1000.0F * static_cast<float>(k / 3) + 4000);
    scene.instances.push_back({number, glm::scale(glm::translate(glm::mat4(1), at), glm::vec3(300))});
  }
  return scene;
}

std::vector<std::uint8_t> pixels(const RayScene& scene, const View& v, int threads, int step) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  RaytracedPicture picture(scene, v, {.samples = 8});
  for (int k = step; k <= 8; k += step) picture.accumulate(k);
  EXPECT_EQ(picture.samples(), 8);
  return picture.image().rgb;
}

TEST(RaytracedPicture, IsTheSameForEveryNumberOfThreadsAndDivisionIntoCalls) {
  const TriangleMesh ground = testing::ground(120, 10000, hills), ball = sphere(24);
  const RayScene scene = hilly(ground, ball);
  const View v = view({5000, 4000, 14000}, {5000, 500, 5000}, 100, 70);
  const auto one = pixels(scene, v, 1, 8);
  EXPECT_EQ(one, pixels(scene, v, 2, 8));
  EXPECT_EQ(one, pixels(scene, v, 2, 2));
  RaytracedPicture other(scene, v, {.samples = 8, .seed = 2});
  other.accumulate();
  EXPECT_NE(one, other.image().rgb);
}

TEST(RaytracedPicture, ShowsInstancesAsCopies) {
  const TriangleMesh shape = box({-1, 0, -1}, {1, 3, 1});
  RayScene instances, copies;
  const auto number = instances.add({.mesh = &shape});
  TriangleMesh all[2];
  for (int k = 0; k < 2; ++k) {
    const glm::mat4 m =
        glm::rotate(glm::scale(glm::translate(glm::mat4(1), {4.0F * static_cast<float>(k) - 2, 0, 0}),
                               glm::vec3(k == 0 ? 1 : -0.5F, 1, 0.7F)),
                    0.6F, glm::vec3(0.1F, 1, 0));
    instances.instances.push_back({number, m});
    all[k] = shape;
    for (glm::vec3& p : all[k].positions) p = glm::vec3(m * glm::vec4(p, 1));
    copies.add_placed({.mesh = &all[k]});
  }
  const View v = view({0, 4, 9}, {0, 1, 0}, 90, 60);
  const auto a = traced(instances, v, {.samples = 8}), b = traced(copies, v, {.samples = 8});
  int differing = 0, covered = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 90; ++x) {
      const glm::vec3 difference = glm::abs(a.radiance(x, y) - b.radiance(x, y));
      if (std::max({difference.x, difference.y, difference.z}) > 1e-4F) ++differing;
      if (a.object(x, y) != b.object(x, y)) ++differing;
      covered += a.object(x, y) > 0 ? 1 : 0;
    }
  }
  EXPECT_LT(differing, 20);  // rounding may decide at edges
  EXPECT_GT(covered, 500);
  EXPECT_EQ(a.object(30, 30), 1U);
  EXPECT_EQ(a.object(59, 30), 2U);
}

TEST(RaytracedPicture, OfAnEmptySceneIsTheSky) {
  RayScene scene;
  scene.light = uniform(0.25F);
  const TriangleMesh nothing;
  scene.add_placed({.mesh = &nothing});
  const auto picture = traced(scene, view({0, 1, 0}, {0, 1, -1}, 40, 33), {.samples = 1});
  EXPECT_EQ(picture.radiance(39, 32), glm::vec3(0.25F));
  EXPECT_EQ(picture.object(3, 3), 0U);
  scene.background = glm::vec3(1);
  EXPECT_EQ(raytrace(scene, view({0, 1, 0}, {0, 1, -1}, 4, 4), {.samples = 1}).pixel(2, 2),
            (Rgb{255, 255, 255}));
}

TEST(RaytracedPicture, DrawsWiresOfTheirWidthAlongTheEdgesNamed) {
  const TriangleMesh sheet = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  RayScene scene;
  scene.light = uniform(1);
  const std::vector<std::uint8_t> sides{0b011, 0b110};                       // all but the diagonal
  const View v = view({0, 0, 2}, {0, 0, 0}, 100, 100, 2 * std::atan(0.5F));  // the sheet fills it
  scene.add_placed({.mesh = &sheet, .material = {.albedo = glm::vec3(0.5F)}, .wire_width = 4});
  scene.meshes[0].wire_color = glm::vec3(0);
  const auto all = traced(scene, v, {.samples = 4});
  scene.meshes[0].wires = sides;
  const auto some = traced(scene, v, {.samples = 4});
  EXPECT_EQ(all.radiance(50, 49).x, 0);
  EXPECT_NEAR(some.radiance(50, 49).x, 0.5F, 1e-5F);
  for (const auto* picture : {&all, &some}) {
    EXPECT_EQ(picture->radiance(30, 98).x, 0);
    EXPECT_EQ(picture->radiance(1, 40).x, 0);
    EXPECT_NEAR(picture->radiance(30, 97).x, 0.5F, 1e-5F);
  }
}

TEST(RaytracedPicture, ReadsMaterialsFromAFunction) {
  const TriangleMesh sheet = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const std::vector<glm::vec2> texture{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const View v = view({0, 0, 2}, {0, 0, 0}, 10, 10, 2 * std::atan(0.5F));
  const auto at = [&](RayMesh mesh, int x, int y) {
    RayScene scene;
    scene.light = uniform(1);
    mesh.mesh = &sheet;
    scene.add_placed(mesh);
    return traced(scene, v, {.samples = 64}).radiance(x, y);
  };
  const auto checker = [](const SurfacePoint& p) {
    return RayMaterial{.albedo = glm::vec3(p.texture.x < 0.5F ? 0.1F : 0.9F, p.texture.y, 0)};
  };
  EXPECT_NEAR(at({.texture = texture, .material_at = checker}, 2, 2).x, 0.1F, 1e-5F);
  EXPECT_NEAR(at({.texture = texture, .material_at = checker}, 7, 2).x, 0.9F, 1e-5F);
  EXPECT_NEAR(at({.texture = texture, .material_at = checker}, 7, 2).y, 0.75F, 0.005F);
}

TEST(RaytracedPicture, StopsWhenInterruptedAndGoesOnLater) {
  const TriangleMesh ball = sphere(16);
  RayScene scene;
  scene.add_placed({.mesh = &ball});
  const View v = view({0, 0, 4}, {0, 0, 0}, 70, 50);
  const auto whole = traced(scene, v, {.samples = 32});
  Progress progress;
  RaytracedPicture picture(scene, v, {.samples = 32});
  picture.accumulate(8, &progress);
  Progress::interrupt();
  const Failure failure = failure_of([&] { picture.accumulate(32, &progress); });
  const Failure building = failure_of([&] { RaytracedPicture(scene, v, {}, &progress); });
  Progress::clear_interrupt();
  EXPECT_EQ(failure.code, ExitCode::kInterrupted);
  EXPECT_EQ(building.code, ExitCode::kInterrupted);
  EXPECT_LT(picture.samples(), 32);
  picture.accumulate(32, &progress);
  EXPECT_EQ(picture.image().rgb, whole.image().rgb);
}

Failure refused(const RayScene& scene, RaytraceSettings settings = {.samples = 1},
                View v = view({0, 0, 4}, {0, 0, 0}, 8, 8)) {
  return failure_of([&] { raytrace(scene, v, settings); });
}

TEST(RaytracedPicture, RefusesUnusableScenes) {
  const TriangleMesh good = sphere(8);
  const auto with = [&](const auto& change) {
    TriangleMesh mesh = good;
    RayScene scene;
    scene.add_placed({.mesh = &mesh});
    change(scene, mesh);
    return refused(scene).what;
  };
  const auto expect = [&](const auto& change, const char* what) {
    EXPECT_THAT(with(change), ::testing::HasSubstr(what));
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  using Scene = RayScene&;
  using Mesh = TriangleMesh&;
  expect([&](Scene, Mesh m) { m.positions[5].y = kNan; }, "position 5");
  expect([&](Scene, Mesh m) { m.normals[7].y = kNan; }, "normal 7");
  expect([&](Scene, Mesh m) { m.normals.pop_back(); }, "normals for");
  expect([&](Scene, Mesh m) { m.indices[10] = 99999; }, "triangle 3");
  expect([&](Scene, Mesh m) { m.indices.pop_back(); }, "multiple of 3");
  expect([&](Scene s, Mesh) { s.instances[0].mesh = 4; }, "does not exist");
  expect([&](Scene s, Mesh) { s.instances[0].to_world[1][1] = 0; }, "invertible");
  expect([&](Scene s, Mesh) { s.instances[0].to_world[3][1] = kNan; }, "finite");
  expect([&](Scene s, Mesh) { s.instances[0].to_world[0][3] = 1; }, "affine");
  expect([&](Scene s, Mesh) { s.meshes[0].mesh = nullptr; }, "no mesh");
  expect([&](Scene s, Mesh) { s.meshes[0].material.albedo.x = 2; }, "material");
  expect([&](Scene s, Mesh) { s.light.sun = glm::vec3(0); }, "sun");
  expect([&](Scene s, Mesh) { s.light.zenith.y = -1; }, "colour");
  const auto broken = [](const SurfacePoint&) { return RayMaterial{.albedo = glm::vec3(kNan)}; };
  expect([&](Scene s, Mesh) { s.meshes[0].material_at = broken; }, "not finite");
}

TEST(RaytracedPicture, RefusesUnusableSettings) {
  const TriangleMesh ball = sphere(64);
  RayScene scene;
  scene.add_placed({.mesh = &ball});
  EXPECT_EQ(refused(scene, {.samples = 0}).code, ExitCode::kUsage);
  EXPECT_EQ(refused(scene, {.samples = 1, .bounces = -1}).code, ExitCode::kUsage);
  EXPECT_EQ(refused(scene, {.samples = 1}, view({0, 0, 4}, {0, 0, 0}, 0, 8)).code, ExitCode::kUsage);
  EXPECT_EQ(refused(scene, {.samples = 1}, view({0, 0, 4}, {0, 0, 0}, 8, 20000)).code, ExitCode::kUsage);
  View upright = view({0, 4, 0}, {0, 0, 0}, 8, 8);
  upright.up = {0, 1, 0};
  EXPECT_EQ(refused(scene, {.samples = 1}, upright).code, ExitCode::kUsage);
}

}  // namespace
}  // namespace terrabench
