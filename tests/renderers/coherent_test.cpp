#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderers/raytrace/coherent/coherent_picture.h"
#include "terrain/error.h"
#include "tests/renderers/raytrace_scenes.h"

namespace terrabench {
namespace {

using namespace terrabench::testing;

glm::vec3 random_point(std::mt19937& random, float size) {
  std::uniform_real_distribution<float> at(-size, size);
  return {at(random), at(random), at(random)};
}

// All boxes by the slab test in double precision, sorted.
std::vector<std::pair<double, std::uint32_t>> entries(const std::vector<Bounds>& boxes, const Ray& ray,
                                                      double far) {
  std::vector<std::pair<double, std::uint32_t>> result;
  for (std::uint32_t b = 0; b < boxes.size(); ++b) {
    double in = ray.near, out = far;
    for (int k = 0; k < 3; ++k) {
      const double one = (double{boxes[b].low[k]} - ray.origin[k]) / ray.direction[k];
      const double two = (double{boxes[b].high[k]} - ray.origin[k]) / ray.direction[k];
      in = std::max(in, std::min(one, two));
      out = std::min(out, std::max(one, two));
    }
    if (in <= out) result.emplace_back(in, b);
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST(BoxTree, VisitsTheBoxesOfARayFromNearToFar) {
  std::mt19937 random(5);
  std::vector<Bounds> boxes;
  for (int b = 0; b < 300; ++b) {
    const glm::vec3 at = random_point(random, 10);
    boxes.push_back({at, at + glm::abs(random_point(random, 5))});
  }
  const BoxTree tree(boxes);
  std::size_t visited = 0;
  for (int r = 0; r < 400; ++r) {
    const Ray ray{.origin = random_point(random, 14), .direction = random_point(random, 1)};
    const float far = r % 3 == 0 ? 6.0F : 1e6F;
    const auto expected = entries(boxes, ray, far);
    BoxVisit at;
    std::vector<std::uint32_t> seen;
    double last = -1;
    while ((at = tree.next(ray, at, far)).found()) {
      seen.push_back(at.box);
      EXPECT_GE(at.entry, last);
      last = at.entry;
      ASSERT_LE(seen.size(), boxes.size());
    }
    ASSERT_EQ(seen.size(), expected.size()) << "ray " << r;
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], expected[i].second);
    visited += seen.size();
  }
  EXPECT_GT(visited, 500U);
}

TEST(BoxTree, TakesNoBoxesAndEqualBoxesAndRefusesBadOnes) {
  const Ray ray{.origin = {0, 0, 5}, .direction = {0, 0, -1}};
  EXPECT_FALSE(BoxTree({}).next(ray, {}, 1e6F).found());
  const std::vector<Bounds> same(9, Bounds{glm::vec3(-1), glm::vec3(1)});
  const BoxTree tree(same);
  BoxVisit at;
  for (std::uint32_t b = 0; b < 9; ++b) {
    at = tree.next(ray, at, 1e6F);
    EXPECT_EQ(at.box, b);
  }
  EXPECT_FALSE(tree.next(ray, at, 1e6F).found());
  EXPECT_THROW(BoxTree(std::vector{Bounds{glm::vec3(1), glm::vec3(0)}}), Error);
  EXPECT_THROW(BoxTree(std::vector{Bounds{glm::vec3(0), glm::vec3(NAN)}}), Error);
}

RayMaterial paint(const SurfacePoint& at) {
  const glm::vec3 stripes = 0.5F + 0.4F * glm::sin(5.0F * at.local);
  return at.instance % 3 == 1   ? RayMaterial{.albedo = stripes, .specular = 0.04F, .roughness = 0.4F}
         : at.instance % 3 == 2 ? RayMaterial{.albedo = stripes, .translucency = 0.3F}
                                : RayMaterial{.albedo = glm::vec3(0.4F)};
}

// A floor, and spheres and boxes on it, as parts and as an eager scene.
struct Objects {
  std::vector<std::unique_ptr<RayPart>> shapes;
  std::vector<std::uint32_t> shape_of;
  std::vector<std::unique_ptr<std::atomic<int>>> opened;
  PartScene parts;
  RayScene scene;
  View view;

  Objects() {
    const auto part = [](TriangleMesh mesh) {
      return std::make_unique<RayPart>(std::move(mesh), std::vector<glm::vec2>{},
                                       std::vector<std::uint32_t>{});
    };
    shapes.push_back(part(quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0})));
    shapes.push_back(part(sphere(12)));
    shapes.push_back(part(box({-1, -1, -1}, {1, 1, 1})));
    place(0, glm::mat4(1));
    std::mt19937 random(9);
    for (std::uint32_t k = 0; k < 14; ++k) {
      const glm::vec3 at = random_point(random, 5);
      glm::mat4 matrix = glm::translate(glm::mat4(1), {at.x, 0.8F, at.z});
      matrix = glm::rotate(matrix, 0.7F * static_cast<float>(k), {0, 1, 0});
      place(1 + k % 2, glm::scale(matrix, {0.5F, 0.8F, 0.6F}));
    }
    parts.light.sun_radius = scene.light.sun_radius = 0.05F;
    parts.open = [this](std::uint32_t number, const std::function<void(const RayPart&)>& use) {
      ++*opened[number];
      use(*shapes[shape_of[number]]);
    };
    parts.material = paint;
    view.eye = {3, 5, 9};
    view.target = {0, 0.5F, 0};
    view.width = 80;
    view.height = 60;
  }

  void place(std::uint32_t shape, const glm::mat4& matrix) {
    const TriangleMesh& mesh = shapes[shape]->mesh;
    TriangleMesh moved = mesh;
    for (glm::vec3& p : moved.positions) p = glm::vec3(matrix * glm::vec4(p, 1));
    Bounds bounds = bounds_of(moved);
    bounds.low -= 1e-4F;
    bounds.high += 1e-4F;
    parts.parts.push_back({bounds, matrix});
    const std::uint32_t number = scene.add({.mesh = &mesh, .material_at = paint});
    scene.instances.push_back({number, matrix});
    shape_of.push_back(shape);
    opened.push_back(std::make_unique<std::atomic<int>>(0));
  }
};

TEST(CoherentPicture, EqualsTheEagerPathTracer) {
  Objects objects;
  const CoherentPicture picture = trace_coherent(objects.parts, objects.view, {.samples = 4, .bounces = 2});
  RaytracedPicture eager(objects.scene, objects.view, {.samples = 4, .bounces = 2});
  eager.accumulate();
  double sum = 0;
  std::size_t other_objects = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * 80 + static_cast<std::size_t>(x);
      sum += glm::length(picture.radiance[at] - eager.radiance(x, y));
      if (picture.objects[at] != eager.object(x, y)) ++other_objects;
    }
  }
  // The same paths, but for rounding where a ray grazes an edge.
  EXPECT_LT(sum / 4800, 0.003);
  EXPECT_LT(other_objects, 400U);  // one looks through the first sample, the other through the middle
}

TEST(CoherentPicture, DependsOnNeitherTilesNorThreads) {
  Objects objects;
  const CoherentPicture picture = trace_coherent(objects.parts, objects.view, {.samples = 2, .bounces = 1});
  const CoherentPicture small =
      trace_coherent(objects.parts, objects.view, {.samples = 2, .bounces = 1, .tile = 7});
  EXPECT_EQ(picture.radiance, small.radiance);
  EXPECT_EQ(picture.objects, small.objects);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  tbb::task_arena(1).execute([&] {
    const CoherentPicture one = trace_coherent(objects.parts, objects.view, {.samples = 2, .bounces = 1});
    EXPECT_EQ(picture.radiance, one.radiance);
  });
}

// Objects behind a wall that fills the view, and its mirror image behind the eye.
TEST(CoherentPicture, OpensOnlyWhatRaysReach) {
  Objects objects;
  const std::size_t before = objects.parts.parts.size();
  objects.shapes.push_back(std::make_unique<RayPart>(quad({-90, -50, -200}, {180, 0, 0}, {0, 100, 0}),
                                                     std::vector<glm::vec2>{}, std::vector<std::uint32_t>{}));
  objects.place(3, glm::mat4(1));
  objects.place(1, glm::translate(glm::mat4(1), {0, 0, -300}));
  objects.view.eye = {0, 5, -150};
  objects.view.target = {0, 5, -200};
  objects.parts.light.sun = {0, 1, 0.01F};
  trace_coherent(objects.parts, objects.view, {.samples = 1, .bounces = 0});
  EXPECT_GT(*objects.opened[before], 0);      // the wall
  EXPECT_EQ(*objects.opened[before + 1], 0);  // what is behind it
}

TEST(CoherentPicture, ShowsTheSkyWhereThereIsNothing) {
  PartScene nothing;
  nothing.light.sky = SkyKind::kUniform;
  nothing.light.zenith = glm::vec3(0.25F);
  nothing.light.sun_irradiance = glm::vec3(0);
  View view;
  view.width = 5;
  view.height = 3;
  const CoherentPicture picture = trace_coherent(nothing, view, {.samples = 3});
  for (const glm::vec3& pixel : picture.radiance) EXPECT_NEAR(pixel.x, 0.25F, 1e-6F);
  EXPECT_EQ(picture.objects, std::vector<std::uint32_t>(15));
  EXPECT_THROW(trace_coherent(nothing, view, {.samples = 0}), Error);
  EXPECT_THROW(trace_coherent(nothing, view, {.bounces = 65}), Error);
  EXPECT_THROW(trace_coherent(nothing, view, {.tile = 0}), Error);
  view.width = 0;
  EXPECT_THROW(trace_coherent(nothing, view, {}), Error);
}

// A process has 1024 thread-local keys, of which each Embree device takes one.
TEST(RayIndex, ThousandsOfIndicesShareADevice) {
  const TriangleMesh shape = sphere(4);
  const RayIndex own(shape);
  std::vector<RayIndex> indices;
  for (int k = 0; k < 2500; ++k) indices.push_back(RayIndex::on_shared_device(shape));
  const Ray ray{.origin = {0.1F, 0.2F, 5}, .direction = {0, 0, -1}};
  for (const RayIndex& index : indices) {
    EXPECT_EQ(index.closest(ray).triangle, own.closest(ray).triangle);
    ASSERT_EQ(index.closest(ray).distance, own.closest(ray).distance);
    ASSERT_EQ(index.bytes(), indices[0].bytes());
  }
  EXPECT_NEAR(static_cast<double>(indices[0].bytes()), static_cast<double>(own.bytes()),
              0.1 * static_cast<double>(own.bytes()));
  TriangleMesh bad = shape;
  bad.indices[0] = 1000;
  EXPECT_THROW(RayIndex::on_shared_device(bad), Error);
}

TEST(RayPart, CountsItsBytes) {
  const std::size_t objects = RayPart::index_objects();
  EXPECT_GT(objects, 0U);
  TriangleMesh mesh = sphere(60);
  const HeapScope heap;
  std::vector<std::uint32_t> tags(mesh.triangles());
  const auto part = std::make_unique<RayPart>(mesh, std::vector<glm::vec2>{}, std::move(tags));
  EXPECT_NEAR(static_cast<double>(part->memory().total()), static_cast<double>(heap.held()),
              0.01 * static_cast<double>(heap.held()));
  EXPECT_EQ(part->bytes(), part->memory().total() + part->index.bytes());
  EXPECT_THROW(RayPart(sphere(3), std::vector<glm::vec2>(2), {}), Error);
}

}  // namespace
}  // namespace terrabench
