// Flow routing and accumulation on synthetic mountains with int16 heights: pixels a second and how time grows
// with the number of pixels (linear: the same rate at every size). The packaged peer, GRASS r.watershed, is a
// program of its own: hydrology_peer.sh runs both on one file.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

#include "terrain/hydrology/accumulate.h"
#include "terrain/hydrology/flow.h"

namespace {

using namespace terrabench;

// A value in [0, 1) for each lattice point.
float lattice(std::uint32_t x, std::uint32_t z, std::uint32_t octave) {
  std::uint32_t h = x * 0x9E3779B1U ^ z * 0x85EBCA77U ^ octave * 0xC2B2AE3DU;
  h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24F;
}

float smooth(float t) { return t * t * (3 - 2 * t); }

// Value noise over octaves from 1024 pixels down to 2: 0 to about 3000 m, `scale` 1 gives whole metres as
// SRTM has them, with its flats and pits.
Heightfield mountains(int size, float scale = 1) {
  Heightfield field;
  field.width = field.depth = size;
  field.heights.resize(static_cast<std::size_t>(size) * size);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      float height = 0, amplitude = 1500;
      for (std::uint32_t octave = 0, wave = 1024; octave < 10; ++octave, wave /= 2, amplitude *= 0.5F) {
        const auto x = static_cast<std::uint32_t>(i) / wave, z = static_cast<std::uint32_t>(j) / wave;
        const float s = smooth(static_cast<float>(i % wave) / static_cast<float>(wave));
        const float t = smooth(static_cast<float>(j % wave) / static_cast<float>(wave));
        const float north = lattice(x, z, octave) * (1 - s) + lattice(x + 1, z, octave) * s;
        const float south = lattice(x, z + 1, octave) * (1 - s) + lattice(x + 1, z + 1, octave) * s;
        height += amplitude * (north * (1 - t) + south * t);
      }
      field.at(i, j) = std::round(height * scale);
    }
  }
  for (float& height : field.heights) height /= scale;
  return field;
}

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
