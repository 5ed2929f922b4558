// Drills on the packaged mountain DEM, 400 × 400 as in the paper (which took about eight minutes to
// extract and a tenth of that to regenerate), and on tiles of it up to 8192², where the rates should not
// change.
#include <benchmark/benchmark.h>

#include "representations/drill/drill_codec.h"
#include "representations/drill/extract.h"
#include "representations/drill/pits.h"
#include "representations/drill/quantum.h"
#include "representations/drill/regenerate.h"
#include "terrain/source.h"

namespace {

using namespace terrabench;

const Heightfield& mountains() {
  static const Heightfield field = resample(*open_terrain("jacksboro").heights, 400, 400);
  return field;
}

// Mirrored at every seam, so that there are no cliffs.
Heightfield tiled(int size) {
  const Heightfield& tile = mountains();
  Heightfield field = tile;
  field.width = field.depth = size;
  field.heights.resize(static_cast<std::size_t>(size) * size);
  const auto mirrored = [](int at, int period) {
    const int within = at % (2 * period);
    return within < period ? within : 2 * period - 1 - within;
  };
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) field.at(i, j) = tile.at(mirrored(i, tile.width), mirrored(j, tile.depth));
  }
  return field;
}

struct Ground {
  Heightfield field;
  FlowNetwork network;
  explicit Ground(int size) : field(size == 400 ? mountains() : tiled(size)), network(route_flow(field)) {}
};

DrillOptions options_for(std::int64_t tau, std::int64_t w, std::int64_t k) {
  DrillOptions options;
  options.tau = static_cast<std::uint32_t>(tau);
  options.w = static_cast<int>(w);
  options.k = static_cast<int>(k);
  return options;
}

void count_drills(benchmark::State& state, const Drills& drills) {
  state.counters["drills"] = static_cast<double>(drills.count());
  state.counters["drills/s"] =
      benchmark::Counter(static_cast<double>(drills.count()), benchmark::Counter::kIsIterationInvariantRate);
}

void extract(benchmark::State& state) {
  const Ground ground(static_cast<int>(state.range(0)));
  const DrillOptions options = options_for(state.range(1), state.range(2), 10);
  Drills drills;
  for (auto _ : state) drills = extract_drills(ground.field, ground.network, options);
  count_drills(state, drills);
}
BENCHMARK(extract)
    ->ArgNames({"size", "tau", "w"})
    ->Args({400, 25, 10})
    ->Args({400, 50, 10})
    ->Args({400, 100, 10})
    ->Args({400, 400, 10})
    ->Args({400, 25, 5})
    ->Args({400, 25, 20})
    ->Args({1024, 25, 10})
    ->Args({2048, 25, 10})
    ->Args({4096, 25, 10})
    ->Args({8192, 25, 10})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void regenerate_terrain(benchmark::State& state) {
  const Ground ground(static_cast<int>(state.range(0)));
  const Drills drills = extract_drills(ground.field, ground.network, options_for(25, 10, state.range(1)));
  std::vector<float> heights(drills.pixels());
  for (auto _ : state) {
    regenerate(drills, heights);
    benchmark::DoNotOptimize(heights.data());
  }
  count_drills(state, drills);
}
BENCHMARK(regenerate_terrain)
    ->ArgNames({"size", "k"})
    ->Args({400, 5})
    ->Args({400, 10})
    ->Args({400, 20})
    ->Args({400, 30})
    ->Args({1024, 20})
    ->Args({2048, 20})
    ->Args({4096, 20})
    ->Args({8192, 20})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void choose_each_influence(benchmark::State& state) {
  const Ground ground(400);
  Drills drills = extract_drills(ground.field, ground.network, options_for(25, 10, 20));
  for (auto _ : state) choose_influence(ground.field, drills);
  count_drills(state, drills);
}
BENCHMARK(choose_each_influence)->Unit(benchmark::kMillisecond)->UseRealTime();

void encode(benchmark::State& state) {
  const Ground ground(static_cast<int>(state.range(0)));
  Drills drills = extract_drills(ground.field, ground.network, {});
  quantise(drills, 2);
  std::size_t bytes = 0;
  for (auto _ : state) {
    ByteSink sink;
    encode_drills(drills, sink);
    bytes = sink.bytes().size();
  }
  count_drills(state, drills);
  state.counters["bits/drill"] = 8 * static_cast<double>(bytes) / static_cast<double>(drills.count());
}
BENCHMARK(encode)->ArgName("size")->Arg(400)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void decode(benchmark::State& state) {
  const Ground ground(static_cast<int>(state.range(0)));
  Drills drills = extract_drills(ground.field, ground.network, {});
  quantise(drills, 2);
  ByteSink sink;
  encode_drills(drills, sink);
  for (auto _ : state) {
    ByteSource source(sink.bytes(), "memory");
    benchmark::DoNotOptimize(decode_drills(source));
  }
  count_drills(state, drills);
}
BENCHMARK(decode)->ArgName("size")->Arg(400)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

void find_pits(benchmark::State& state) {
  const Ground ground(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(count_pits(ground.field));
}
BENCHMARK(find_pits)->ArgName("size")->Arg(400)->Arg(4096)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
