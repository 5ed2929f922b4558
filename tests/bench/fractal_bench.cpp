// The generators compared with the textbook forms of the methods on the same terrain. vs_naive is the
// ratio of thread times measured in the same run; the naive loops of faults and hills are timed on a smaller
// share of the work and scaled, since they would take minutes.
#include <benchmark/benchmark.h>
#include <libnoise/noise.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <map>
#include <vector>

#include "terrain/sources/fractal/counter_random.h"
#include "terrain/sources/fractal/diamond_square.h"
#include "terrain/sources/fractal/faults.h"
#include "terrain/sources/fractal/hills.h"
#include "terrain/sources/fractal/limits.h"

namespace terrabench::fractal {
namespace {

// Seconds of the fastest call, by side: the least disturbed one on a busy machine.
using Fastest = std::map<std::int64_t, double>;

double seconds_of(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// `share`: of the work that body() does.
template <class Body>
double measure(benchmark::State& state, clockid_t clock, double share, const Body& body) {
  double best = 1e30;
  for (auto _ : state) {
    const double begin = seconds_of(clock);
    body();
    best = std::min(best, (seconds_of(clock) - begin) / share);
  }
  const auto side = static_cast<double>(state.range(0));
  state.counters["ns_a_sample"] = best * 1e9 / (side * side);
  state.counters["fastest_ms"] = best * 1e3;
  return best;
}

// Thread time on one thread, wall time on all.
template <class Body>
void measure_ours(benchmark::State& state, const Fastest& naive, bool all_threads, const Body& body) {
  constexpr auto kThreads = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control limit(kThreads, all_threads ? tbb::global_control::active_value(kThreads) : 1);
  const double best = measure(state, all_threads ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID, 1, body);
  const auto found = naive.find(state.range(0));
  if (found != naive.end() && !all_threads) state.counters["vs_naive"] = found->second / best;
}

Fastest g_diamond_square, g_faults, g_planet, g_hills;
constexpr int kFaults = 1000, kHills = 1000;

int side_of(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

// Steps within the final array, one hash per point, as the method is usually written.
void naive_diamond_square(benchmark::State& state) {
  const int side = side_of(state), last = side - 1;
  g_diamond_square[state.range(0)] = measure(state, CLOCK_THREAD_CPUTIME_ID, 1, [&] {
    std::vector<float> h(static_cast<std::size_t>(side) * side);
    const auto at = [&](int x, int z) -> float& { return h[static_cast<std::size_t>(z) * side + x]; };
    float range = 1000;
    for (int half = last / 2; half > 0; half /= 2) {
      const auto moved = [&](int x, int z) {
        return range * displacement({static_cast<std::uint32_t>(z) * kMixB, static_cast<std::uint32_t>(half)},
                                    static_cast<std::uint32_t>(x));
      };
      for (int z = half; z < last; z += 2 * half) {
        for (int x = half; x < last; x += 2 * half) {
          at(x, z) = 0.25F * (at(x - half, z - half) + at(x + half, z - half) + at(x - half, z + half) +
                              at(x + half, z + half)) +
                     moved(x, z);
        }
      }
      for (int z = 0; z <= last; z += half) {
        for (int x = (z / half) % 2 == 0 ? half : 0; x <= last; x += 2 * half) {
          const int north = z == 0 ? last - half : z - half, south = z == last ? half : z + half;
          const int west = x == 0 ? last - half : x - half, east = x == last ? half : x + half;
          at(x, z) =
              0.25F * (at(x, north) + at(x, south) + at(west, z) + at(east, z)) + moved(x % last, z % last);
        }
      }
      range *= 0.574F;
    }
    benchmark::DoNotOptimize(h.data());
  });
}

void our_diamond_square(benchmark::State& state, bool all_threads) {
  measure_ours(state, g_diamond_square, all_threads,
               [&] { benchmark::DoNotOptimize(diamond_square({.side = side_of(state)}).heights.data()); });
}

void naive_faults(benchmark::State& state) {
  constexpr int kSome = 50;
  const FaultOptions options{.width = side_of(state), .depth = side_of(state), .faults = kSome};
  g_faults[state.range(0)] =
      measure(state, CLOCK_THREAD_CPUTIME_ID, static_cast<double>(kSome) / kFaults, [&] {
        std::vector<float> h(static_cast<std::size_t>(options.width) * options.depth);
        for (const FaultLine& line : fault_lines(options)) {
          for (int j = 0; j < options.depth; ++j) {
            float* const row = h.data() + static_cast<std::ptrdiff_t>(j) * options.width;
            const auto rest = static_cast<float>(line.c - line.b * j), a = static_cast<float>(line.a);
            for (int i = 0; i < options.width; ++i)
              row[i] += a * static_cast<float>(i) > rest ? 20.0F : -20.0F;
          }
        }
        benchmark::DoNotOptimize(h.data());
      });
}

void our_faults(benchmark::State& state, bool all_threads) {
  const FaultOptions options{.width = side_of(state), .depth = side_of(state), .faults = kFaults};
  measure_ours(state, g_faults, all_threads,
               [&] { benchmark::DoNotOptimize(fault_terrain(options).heights.data()); });
}

void naive_planet(benchmark::State& state) {
  constexpr int kSome = 50;
  const int side = side_of(state);
  const PlanetFaultOptions options{.width = side, .depth = side, .faults = kSome};
  g_planet[state.range(0)] =
      measure(state, CLOCK_THREAD_CPUTIME_ID, static_cast<double>(kSome) / kFaults, [&] {
        std::vector<float> h(static_cast<std::size_t>(side) * side), sine, cosine;
        for (int i = 0; i < side; ++i) {
          sine.push_back(std::sin(6.2831853F * static_cast<float>(i) / static_cast<float>(side - 1)));
          cosine.push_back(std::cos(6.2831853F * static_cast<float>(i) / static_cast<float>(side - 1)));
        }
        for (const FaultPlane& plane : fault_planes(options)) {
          for (int j = 0; j < side; ++j) {
            const float latitude =
                1.5707963F - 3.1415927F * static_cast<float>(j) / static_cast<float>(side - 1);
            const auto a = static_cast<float>(plane.x) * std::cos(latitude);
            const auto b = static_cast<float>(plane.z) * std::cos(latitude);
            const auto c = static_cast<float>(plane.offset - plane.y * std::sin(latitude));
            float* const row = h.data() + static_cast<std::ptrdiff_t>(j) * side;
            for (int i = 0; i < side; ++i) {
              const auto at = static_cast<std::size_t>(i);
              row[i] += a * cosine[at] + b * sine[at] > c ? 20.0F : -20.0F;
            }
          }
        }
        benchmark::DoNotOptimize(h.data());
      });
}

void our_planet(benchmark::State& state, bool all_threads) {
  const PlanetFaultOptions options{.width = side_of(state), .depth = side_of(state), .faults = kFaults};
  measure_ours(state, g_planet, all_threads,
               [&] { benchmark::DoNotOptimize(planet_faults(options).heights.data()); });
}

// Hills of up to a fifth of the field.
HillOptions hill_options(int side, int hills) {
  const float extent = 30.0F * static_cast<float>(side);
  return {
      .width = side, .depth = side, .hills = hills, .least_radius = extent / 100, .most_radius = extent / 10};
}

void naive_hills(benchmark::State& state) {
  constexpr int kSome = 50;
  const HillOptions options = hill_options(side_of(state), kSome);
  g_hills[state.range(0)] = measure(state, CLOCK_THREAD_CPUTIME_ID, static_cast<double>(kSome) / kHills, [&] {
    std::vector<float> h(static_cast<std::size_t>(options.width) * options.depth);
    for (const Hill& hill : draw_hills(options)) {
      for (int j = 0; j < options.depth; ++j) {
        float* const row = h.data() + static_cast<std::ptrdiff_t>(j) * options.width;
        const float dz = static_cast<float>(j) * options.cell - hill.z;
        for (int i = 0; i < options.width; ++i) {
          const float dx = static_cast<float>(i) * options.cell - hill.x;
          row[i] += std::max(0.0F, hill.radius * hill.radius - dx * dx - dz * dz);
        }
      }
    }
    benchmark::DoNotOptimize(h.data());
  });
}

void our_hills(benchmark::State& state, bool all_threads) {
  const HillOptions options = hill_options(side_of(state), kHills);
  measure_ours(state, g_hills, all_threads,
               [&] { benchmark::DoNotOptimize(hill_terrain(options).heights.data()); });
}

// The packaged peer, libnoise on one thread: fractal ground with one octave per level of diamond-square.
void libnoise_fbm(benchmark::State& state) {
  const int side = side_of(state);
  ::noise::module::Perlin module;
  module.SetOctaveCount(static_cast<int>(std::log2(side)));
  module.SetFrequency(1.0 / side);
  constexpr int kRows = 64;
  measure(state, CLOCK_THREAD_CPUTIME_ID, static_cast<double>(kRows) / side, [&] {
    double sum = 0;
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i < side; ++i) sum += module.GetValue(i, 0.5, j);
    }
    benchmark::DoNotOptimize(sum);
  });
}

// The naive ones come first: the ratios need them.
#define FRACTAL_SIDES Arg(1025)->Arg(4097)->Unit(benchmark::kMillisecond)->UseRealTime()
BENCHMARK(libnoise_fbm)->FRACTAL_SIDES;
BENCHMARK(naive_diamond_square)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_diamond_square, one_thread, false)->FRACTAL_SIDES->Arg(16385);
BENCHMARK_CAPTURE(our_diamond_square, all_threads, true)->FRACTAL_SIDES->Arg(16385);
BENCHMARK(naive_faults)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_faults, one_thread, false)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_faults, all_threads, true)->FRACTAL_SIDES;
BENCHMARK(naive_planet)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_planet, one_thread, false)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_planet, all_threads, true)->FRACTAL_SIDES;
BENCHMARK(naive_hills)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_hills, one_thread, false)->FRACTAL_SIDES;
BENCHMARK_CAPTURE(our_hills, all_threads, true)->FRACTAL_SIDES;

}  // namespace
}  // namespace terrabench::fractal
