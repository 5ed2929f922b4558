// The cost of choosing factors for tessellated patches, on 4097² samples: mean over the frames of a flight.
#include <benchmark/benchmark.h>

#include <vector>

#include "lod/camera/camera_path.h"
#include "lod/tessellated/tessellated.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

struct Scene {
  Heightfield ground = mountains(4097);
  std::vector<View> path = views(camera_path("fly"), ground);
};
const Scene& scene() {
  static const Scene scene;
  return scene;
}

void update(benchmark::State& state) {
  Progress silent;
  Tessellated lod(scene().ground, {static_cast<int>(state.range(0)), state.range(1) != 0}, silent);
  lod.tune(state.range(1) != 0 ? 2 : 16);
  std::size_t frames = 0, triangles = 0, patches = 0;
  for (auto _ : state) {
    const Frame& frame = lod.update(scene().path[frames++ % scene().path.size()]);
    triangles += frame.stats.triangles;
    patches += frame.patches.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(frames);
  state.counters["patches"] = static_cast<double>(patches) / static_cast<double>(frames);
}
BENCHMARK(update)
    ->ArgNames({"patch", "by_error"})
    ->ArgsProduct({{16, 32, 64}, {1, 0}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace terrabench
