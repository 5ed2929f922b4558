// The cost of choosing the nodes of CDLOD, with its ranges by distance, on 4097² samples 30 m apart: mean
// over the frames of a flight, at the setting that draws about as much as the paper reports. It chose 105
// thousand triangles in 84 batches in 0.075 ms, on its machine and over larger ground.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "lod/camera/camera_path.h"
#include "lod/cdlod/cdlod.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

constexpr double kTriangles = 105'000;

struct Scene {
  Heightfield ground = [] {
    Heightfield made = mountains(4097);
    made.cell_x = made.cell_z = 30;
    return made;
  }();
  std::vector<View> path = views(camera_path("fly"), ground);
};
const Scene& scene() {
  static const Scene scene;
  return scene;
}

struct Mean {
  double triangles = 0, batches = 0;
};

Mean fly(Cdlod& lod) {
  Mean mean;
  for (const View& view : scene().path) {
    const Frame& frame = lod.update(view);
    mean.triangles += static_cast<double>(frame.stats.triangles);
    mean.batches += static_cast<double>(frame.batches.size());
  }
  const auto frames = static_cast<double>(scene().path.size());
  return {mean.triangles / frames, mean.batches / frames};
}

void choose(benchmark::State& state) {
  Progress silent;
  Cdlod lod(scene().ground, {static_cast<int>(state.range(0)), true}, silent);
  double fine = 0.5, coarse = 50;
  Mean drawn;
  for (int step = 0; step < 12; ++step) {
    const double knob = std::sqrt(fine * coarse);
    lod.tune(knob);
    drawn = fly(lod);
    (drawn.triangles > kTriangles ? fine : coarse) = knob;
  }
  for (auto _ : state) {
    for (const View& view : scene().path) benchmark::DoNotOptimize(lod.update(view).batches.data());
  }
  state.counters["triangles"] = drawn.triangles;
  state.counters["batches"] = drawn.batches;
  state.counters["s_per_update"] =
      benchmark::Counter(static_cast<double>(scene().path.size()),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(choose)->ArgName("node")->Arg(16)->Arg(32)->Arg(64)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace terrabench
