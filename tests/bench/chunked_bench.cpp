// Chunked LOD on mountains of 1025² and 4097² samples 30 m apart: building all chunks, an update along a
// flight at 2 px, and an edit of 64 × 64 samples.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "lod/camera/camera_path.h"
#include "lod/chunked/chunked.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

const Heightfield& ground(std::int64_t side) {
  static std::map<std::int64_t, Heightfield> grounds;
  Heightfield& field = grounds[side];
  if (field.heights.empty()) {
    field = mountains(static_cast<int>(side));
    field.cell_x = field.cell_z = 30;
  }
  return field;
}

void build(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(state.range(0));
  std::size_t bytes = 0;
  for (auto _ : state) {
    bytes = std::make_unique<Chunked>(field, Chunked::Options{static_cast<int>(state.range(1))}, silent)
                ->memory()
                .total();
  }
  state.counters["bytes_per_sample"] = static_cast<double>(bytes) / static_cast<double>(field.heights.size());
}

void update(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(4097);
  Chunked lod(field, {static_cast<int>(state.range(0))}, silent);
  const std::vector<View> path = views(camera_path("fly"), field);
  std::size_t frames = 0, triangles = 0, batches = 0;
  for (auto _ : state) {
    const Frame& frame = lod.update(path[frames++ % path.size()]);
    triangles += frame.stats.triangles;
    batches += frame.batches.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(frames);
  state.counters["batches"] = static_cast<double>(batches) / static_cast<double>(frames);
}

void edit(benchmark::State& state) {
  Progress silent;
  Heightfield field = ground(1025);
  Chunked lod(field, {}, silent);
  for (auto _ : state) lod.edited({{200, 200}, {263, 263}});
}

BENCHMARK(build)->ArgsProduct({{1025, 4097}, {8, 16}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(update)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond)->UseRealTime();
BENCHMARK(edit)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace terrabench
