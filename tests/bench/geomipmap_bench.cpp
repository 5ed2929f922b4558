// Geomipmapping on 4097²: building, and update() along a committed path, by patch side, error bound and
// morph.
#include <benchmark/benchmark.h>

#include <memory>

#include "lod/camera/camera_path.h"
#include "lod/geomipmap/geomipmap.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

const Heightfield& ground() {
  static const Heightfield kGround = [] {
    Heightfield field = mountains(4097);
    field.cell_x = field.cell_z = 10;  // 41 km, 3 km high
    return field;
  }();
  return kGround;
}

void build(benchmark::State& state) {
  Progress silent;
  const GeoMipMap::Options options{static_cast<int>(state.range(0)), false, state.range(1) != 0};
  double bytes = 0;
  for (auto _ : state) {
    const auto lod = std::make_unique<GeoMipMap>(
        ground(), options, silent);  // on the heap, because memory() measures the object's own block
    bytes = static_cast<double>(lod->memory().total());
  }
  state.counters["bytes_per_sample"] = bytes / static_cast<double>(ground().heights.size());
}
BENCHMARK(build)->ArgNames({"side", "morph"})->ArgsProduct({{32, 64}, {0, 1}})->Unit(benchmark::kMillisecond);

// One iteration is one frame. range: patch side, pixels, morph.
void update(benchmark::State& state, const char* path) {
  Progress silent;
  GeoMipMap lod(ground(), {static_cast<int>(state.range(0)), false, state.range(2) != 0}, silent);
  lod.tune(static_cast<double>(state.range(1)));
  const std::vector<View> frames = views(camera_path(path), ground());
  lod.update(frames[0]);
  double triangles = 0, batches = 0;
  std::size_t at = 0;
  for (auto _ : state) {
    at = (at + 1) % frames.size();
    const Frame& frame = lod.update(frames[at]);
    triangles += static_cast<double>(frame.stats.triangles);
    batches += static_cast<double>(frame.batches.size());
  }
  state.counters["triangles"] = benchmark::Counter(triangles, benchmark::Counter::kAvgIterations);
  state.counters["batches"] = benchmark::Counter(batches, benchmark::Counter::kAvgIterations);
}
void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"side", "px", "morph"})->Unit(benchmark::kMicrosecond)->MinTime(0.3);
  benchmark->Args({32, 2, 0})->Args({64, 2, 0})->Args({64, 1, 0})->Args({64, 4, 0})->Args({64, 2, 1});
}
BENCHMARK_CAPTURE(update, walk, "walk")->Apply(cases);
BENCHMARK_CAPTURE(update, cross, "cross")->Apply(cases);
BENCHMARK_CAPTURE(update, fly, "fly")->Apply(cases);
BENCHMARK_CAPTURE(update, turn, "turn")->Apply(cases);

}  // namespace
}  // namespace terrabench
