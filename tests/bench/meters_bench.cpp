// The cost of measuring one frame of brute force, which draws everything in view of 4097².
#include <benchmark/benchmark.h>

#include "lod/brute_force/brute_force.h"
#include "lod/camera/camera_path.h"
#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "terrain/metrics/image_error.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

struct Scene {
  Heightfield ground = mountains(4097);
  View view = views(camera_path("fly"), ground)[100];
  BruteForce lod{ground};
  const Frame& frame = lod.update(view);
  double triangles = static_cast<double>(frame.stats.triangles);
};
Scene& scene() {
  static Scene scene;
  return scene;
}

void rate(benchmark::State& state, double count, const char* what) {
  state.counters[what] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
}

void raster(benchmark::State& state) {
  Scene& s = scene();
  SurfaceRaster drawn(s.ground.width, s.ground.depth);
  for (auto _ : state) drawn.draw(s.frame);
  rate(state, s.triangles, "triangles/s");
}
void visibility(benchmark::State& state) {
  Scene& s = scene();
  for (auto _ : state) benchmark::DoNotOptimize(SeenSamples(s.ground, s.view).at(0, 0));
  rate(state, s.triangles, "triangles/s");
}
void error(benchmark::State& state) {
  Scene& s = scene();
  const SeenSamples seen(s.ground, s.view);
  const SurfaceRaster drawn(s.frame, s.ground.width, s.ground.depth);
  double samples = 0;
  for (auto _ : state) samples = static_cast<double>(screen_error(drawn, s.ground, seen).in_frustum.samples);
  rate(state, samples, "samples/s");
}
void cracks(benchmark::State& state) {
  Scene& s = scene();
  std::size_t gaps = 0;
  for (auto _ : state) gaps += find_cracks(s.frame, s.ground.width, s.ground.depth, s.view).gaps;
  benchmark::DoNotOptimize(gaps);
  rate(state, s.triangles, "triangles/s");
}
void similarity(benchmark::State& state) {
  const Image a(800, 600, {90, 100, 110}), b(800, 600, {91, 99, 105});
  for (auto _ : state) benchmark::DoNotOptimize(ssim(a, b));
  rate(state, 800 * 600, "pixels/s");
}
BENCHMARK(raster)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(visibility)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(error)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(cracks)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(similarity)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace terrabench
