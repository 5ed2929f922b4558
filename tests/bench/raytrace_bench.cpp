// The ray tracer on a hill range of 2 M triangles: indexing, coherent and random rays by thread count, whole
// pictures, and instances against copies. Then representations' own ray casters beside Embree on their mesh.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "renderers/raytrace/raytraced_picture.h"
#include "representations/ray_cast.h"
#include "tests/bench/mountains.h"
#include "tests/renderers/ground.h"

namespace {

using namespace terrabench;

constexpr int kSide = 1000;  // cells; two triangles each
constexpr float kExtent = 10000;
constexpr std::size_t kRays = 1U << 20;

const TriangleMesh& hills_mesh() {
  static const TriangleMesh mesh = testing::ground(kSide, kExtent, testing::hills);
  return mesh;
}

const RayIndex& hills_index() {
  static const RayIndex index(hills_mesh());
  return index;
}

View view_of_hills(int width, int height) {
  View view = overview(bounds_of(hills_mesh()), width, height);
  return view;
}

std::vector<Ray> camera_rays() {
  const RayCamera camera(view_of_hills(1024, 1024));
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < kRays; ++k) {
    rays.push_back(camera.ray({static_cast<float>(k % 1024) + 0.5F, static_cast<float>(k / 1024) + 0.5F}));
  }
  return rays;
}

// From points over the ground in all directions.
std::vector<Ray> random_rays() {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> in(0, 1);
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < kRays; ++k) {
    const float y = 2 * in(random)-1, r = std::sqrt(1 - y * y), turn = 6.2831853F * in(random);
    rays.push_back({.origin = {kExtent * in(random), 1100, kExtent * in(random)},
                    .direction = {r * std::cos(turn), y, r * std::sin(turn)}});
  }
  return rays;
}

void commit(benchmark::State& state) {
  double bytes = 0;
  for (auto _ : state) bytes = static_cast<double>(RayIndex(hills_mesh()).bytes());
  const auto triangles = static_cast<double>(hills_mesh().triangles());
  state.counters["triangles"] = triangles;
  state.counters["bytes/triangle"] = bytes / triangles;
}

void closest(benchmark::State& state, std::vector<Ray> (*make)()) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, state.range(0));
  const std::vector<Ray> rays = make();
  const RayIndex& index = hills_index();
  std::vector<RayHit> hits(rays.size());
  for (auto _ : state) {
    index.closest(rays, hits);
    benchmark::DoNotOptimize(hits.data());
  }
  state.counters["rays/s"] =
      benchmark::Counter(static_cast<double>(rays.size()), benchmark::Counter::kIsIterationInvariantRate);
}

// One picture of 400 × 250 pixels with 16 samples, sun, sky and two bounces.
void picture(benchmark::State& state) {
  RayScene scene;
  scene.add_placed({.mesh = &hills_mesh()});
  RaytracedPicture traced(scene, view_of_hills(400, 250), {.samples = 1});
  int samples = 0;
  for (auto _ : state) traced.accumulate(samples += 16);
  state.counters["samples/s"] =
      benchmark::Counter(400 * 250 * 16, benchmark::Counter::kIsIterationInvariantRate);
}

// A field of 100 × 100 instances of a hill of 20,000 triangles.
void instances(benchmark::State& state) {
  const TriangleMesh hill = testing::ground(100, kExtent, testing::hills);
  std::vector<MeshPlacement> placements;
  for (int k = 0; k < 10000; ++k) {
    const glm::vec3 at(kExtent * static_cast<float>(k % 100), 1, kExtent * static_cast<float>(k / 100));
    placements.push_back({0, glm::translate(glm::mat4(1), at)});
  }
  const TriangleMesh* const meshes[] = {&hill};
  double bytes = 0;
  for (auto _ : state) bytes = static_cast<double>(RayIndex(meshes, placements).bytes());
  state.counters["triangles"] = 1e4 * static_cast<double>(hill.triangles());
  state.counters["bytes/instance"] = bytes / 1e4;
}

// A representation of mountains of 1025² samples 30 m apart, its caster, and Embree's index of its mesh.
struct Cast {
  std::unique_ptr<Representation> built;
  TriangleMesh mesh;
  std::unique_ptr<RayCaster> own;
  std::unique_ptr<RayIndex> index;
  double own_seconds = 0, index_seconds = 0;  // to make
};

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const Cast& cast_of(const std::string& name) {
  static std::map<std::string, Cast> all;
  Cast& cast = all[name];
  if (cast.built) return cast;
  Heightfield ground = mountains(1025);
  ground.cell_x = ground.cell_z = 30;
  const RepresentationType& type = representation(name);
  Progress progress;
  cast.built = type.build(source_of("mountains", std::move(ground)), Parameters(type.parameters), progress);
  cast.mesh = cast.built->mesh({});
  cast.own_seconds = seconds([&] { cast.own = cast.built->ray_caster(); });
  cast.index_seconds = seconds([&] { cast.index = std::make_unique<RayIndex>(cast.mesh); });
  return cast;
}

// From above, 15° to 90° down; or along the ground, 60 m above it and within 6° of the horizontal.
std::vector<Ray> rays_over(const Cast& cast, bool along) {
  constexpr std::size_t kCount = 1U << 17;
  const Bounds bounds = cast.built->bounds();
  std::mt19937 random(1);
  std::uniform_real_distribution<float> in(0, 1);
  std::vector<Ray> rays(kCount);
  for (Ray& ray : rays) {
    ray.origin = bounds.low + glm::vec3(in(random), 1.1F, in(random)) * bounds.size();
    const float turn = 6.2831853F * in(random);
    const float rise = along ? 0.2F * in(random)-0.1F : -0.2618F - 1.309F * in(random);
    ray.direction = {std::cos(rise) * std::cos(turn), std::sin(rise), std::cos(rise) * std::sin(turn)};
  }
  if (!along) return rays;
  for (Ray& ray : rays) {
    const Ray down{ray.origin, {0, -1, 0}};
    const float distance = cast.index->closest(down).distance;
    ray.origin.y -= std::isfinite(distance) ? distance - 60 : bounds.size().y;
  }
  return rays;
}

// `vs_embree`: our rate over Embree's, measured one after the other.
void own_rays(benchmark::State& state, const std::string& name, bool along) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Cast& cast = cast_of(name);
  const std::vector<Ray> rays = rays_over(cast, along);
  std::vector<float> distances(rays.size());
  std::vector<RayHit> hits(rays.size());
  double own = 0, embree = 0;
  for (auto _ : state) {
    const double once = seconds([&] { cast.own->closest(rays, distances); });
    state.SetIterationTime(once);
    own += once;
    embree += seconds([&] { cast.index->closest(rays, hits); });
  }
  const auto n = static_cast<double>(rays.size()), rounds = static_cast<double>(state.iterations());
  state.counters["rays/s"] = n * rounds / own;
  state.counters["Embree rays/s"] = n * rounds / embree;
  state.counters["vs_embree"] = embree / own;
  state.counters["make s"] = cast.own_seconds;
  state.counters["Embree make s"] = cast.index_seconds;
  state.counters["MB"] = 1e-6 * static_cast<double>(cast.own->bytes());
  state.counters["Embree MB"] = 1e-6 * static_cast<double>(cast.index->bytes());
}

BENCHMARK(commit)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(closest, camera, camera_rays)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(closest, random, random_rays)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(picture)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
BENCHMARK(instances)->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

#define OWN_RAYS(type)                                                      \
  BENCHMARK_CAPTURE(own_rays, type##_above, #type, false)->UseManualTime(); \
  BENCHMARK_CAPTURE(own_rays, type##_along, #type, true)->UseManualTime()
OWN_RAYS(heightmap);
OWN_RAYS(layered_stack);
OWN_RAYS(voxel);
OWN_RAYS(dense_voxel);
OWN_RAYS(drill);
OWN_RAYS(ght);
OWN_RAYS(implicit);

}  // namespace
