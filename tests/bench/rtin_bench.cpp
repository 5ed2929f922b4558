// Right-triangulated irregular networks: the errors of a tile of 513² or 4097² samples, exact and as
// published, a mesh of the tile at an error in metres, and an update along a flight.
#include <benchmark/benchmark.h>

#include <map>

#include "lod/camera/camera_path.h"
#include "lod/cbt/cbt.h"
#include "lod/rtin/rtin.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

const Heightfield& ground(std::int64_t side) {
  static std::map<std::int64_t, Heightfield> grounds;
  Heightfield& field = grounds[side];
  if (field.heights.empty()) field = mountains(static_cast<int>(side));
  return field;
}

void errors(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(state.range(0));
  for (auto _ : state) {
    const rtin::NestedErrors errors(grid_of(field), state.range(1) != 0, silent);
    benchmark::DoNotOptimize(errors.at({0, 1}));
  }
}

void mesh(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(513);
  Rtin lod(field, {.exact = false, .metres = static_cast<double>(state.range(0))}, silent);
  const View view = views(camera_path("fly"), field)[100];
  std::size_t triangles = 0;
  for (auto _ : state) triangles = lod.update(view).stats.triangles;
  state.counters["triangles"] = static_cast<double>(triangles);
}

template <class Method>
void update(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(4097);
  Method lod(field, {}, silent);
  const std::vector<View> path = views(camera_path("fly"), field);
  lod.update(path[0]);
  std::size_t frames = 0, triangles = 0;
  for (auto _ : state) triangles += lod.update(path[++frames % path.size()]).stats.triangles;
  state.counters["triangles"] = static_cast<double>(triangles) / static_cast<double>(frames);
}

void edit(benchmark::State& state) {
  Progress silent;
  const Heightfield& field = ground(4097);
  rtin::NestedErrors errors(grid_of(field), true, silent);
  for (auto _ : state) errors.update({1000, 1000}, {1063, 1063});
}

BENCHMARK(errors)->ArgsProduct({{513, 4097}, {0, 1}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(mesh)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK(update<Rtin>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(update<Cbt>)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(edit)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace terrabench
