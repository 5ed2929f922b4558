// The ray tracer on a hill range of 2 M triangles: indexing, coherent and random rays by thread count, whole
// pictures, and instances against copies. cross.representations times other ray casters beside Embree.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <vector>

#include "renderers/raytrace/raytraced_picture.h"
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

}  // namespace
