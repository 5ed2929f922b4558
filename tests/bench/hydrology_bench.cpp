// Flow routing and accumulation on synthetic mountains with int16 heights: pixels per second and how time
// grows with the number of pixels (linear: the same rate at every size). The packaged peer, GRASS
// r.watershed, is a separate program: hydrology_peer.cpp runs both.
#include <benchmark/benchmark.h>

#include "terrain/hydrology/accumulate.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "tests/bench/mountains.h"

namespace {

using namespace terrabench;

void count_pixels(benchmark::State& state, const Heightfield& field) {
  state.counters["pixels/s"] = benchmark::Counter(static_cast<double>(field.heights.size()),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void route_int16(benchmark::State& state) {
  const Heightfield field = mountains(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(route_flow(field));
  count_pixels(state, field);
}
BENCHMARK(route_int16)->RangeMultiplier(2)->Range(512, 8192)->Unit(benchmark::kMillisecond)->UseRealTime();

void route_float(benchmark::State& state) {
  const Heightfield field = mountains(static_cast<int>(state.range(0)), 1000.3F);
  for (auto _ : state) benchmark::DoNotOptimize(route_flow(field));
  count_pixels(state, field);
}
BENCHMARK(route_float)->RangeMultiplier(2)->Range(512, 4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void accumulate_only(benchmark::State& state) {
  const Heightfield field = mountains(static_cast<int>(state.range(0)));
  const FlowNetwork network = route_flow(field);
  for (auto _ : state) benchmark::DoNotOptimize(hydrology::accumulate(network));
  count_pixels(state, field);
}
BENCHMARK(accumulate_only)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void list_channels(benchmark::State& state) {
  const Heightfield field = mountains(static_cast<int>(state.range(0)));
  const FlowNetwork network = route_flow(field);
  for (auto _ : state) benchmark::DoNotOptimize(channel_pixels(network, 25));
  count_pixels(state, field);
}
BENCHMARK(list_channels)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
