// A clipmap's window of 511² samples that moves by one step: two columns or two rows of one level are read
// and uploaded, 4 kB, and the blocks' bounds change. Over 8193² samples, from an eye so high that the first
// two levels are left out; of its steps, those that move one window.
#include <benchmark/benchmark.h>

#include "experiments/stopwatch.h"
#include "lod/clipmap/clipmap.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

constexpr int kWindow = 511, kLevel = 2, kSide = 8193;
constexpr std::size_t kStrip = 2 * kWindow * sizeof(float);

const Heightfield& ground() {
  static const Heightfield ground = mountains(kSide);
  return ground;
}

void move_one_window(benchmark::State& state) {
  Clipmap lod(heights_in_memory(ground()), kWindow);
  constexpr float kStep = 2 << kLevel;
  View view;
  view.near = 10;
  view.far = 4 * kSide;
  const float high = 0.3F * (kWindow << kLevel);
  float along = 0.3F * kSide, way = 1;
  for (auto _ : state) {
    double seconds = 0;
    do {
      if (along > 0.7F * kSide || along < 0.3F * kSide) way = -way;
      along += way * kStep;
      view.eye = state.range(0) != 0 ? glm::vec3(along, 0, 0.5F * kSide) : glm::vec3(0.5F * kSide, 0, along);
      view.eye.y = ground().sample(view.eye.x, view.eye.z) + high;
      view.target = view.eye + glm::vec3(0.3F, -1, 0.2F);
      const Frame* frame = nullptr;
      seconds = processor_seconds([&] { frame = &lod.update(view); });
      if (frame->stats.bytes_uploaded == kStrip) break;
    } while (true);
    state.SetIterationTime(seconds);
  }
}
BENCHMARK(move_one_window)
    ->ArgName("along_x")
    ->Arg(1)
    ->Arg(0)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace terrabench
