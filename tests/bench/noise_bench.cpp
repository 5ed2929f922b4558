// Noise beside libnoise on the same fractals and the same points, and the cave terrain column by column.
// times_libnoise is the ratio of thread time measured in this very run.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>
#include <libnoise/noise.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <vector>

#include "terrain/sources/noise/cave_terrain.h"
#include "terrain/sources/noise/program.h"

namespace terrabench {
namespace {

constexpr int kOctaves = 6;
constexpr float kFrequency = 1.0F / 32;
enum Subject { kPerlin, kRidged };

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Points in no order that a column or a cache could use.
struct Points {
  std::vector<float> x, y, z;
};
const Points& points() {
  static const Points made = [] {
    Points p;
    std::uint64_t state = 1;
    const auto next = [&] {
      state = state * 6364136223846793005U + 1442695040888963407U;
      return static_cast<float>(state >> 40) * 0x1p-24F * 1000.0F - 500.0F;
    };
    for (int i = 0; i < 1 << 14; ++i) {
      p.x.push_back(next());
      p.y.push_back(next());
      p.z.push_back(next());
    }
    return p;
  }();
  return made;
}

// Samples a second of thread time of the fastest iteration so far.
std::array<double, 2> g_libnoise{};

template <class Body>
void measure(benchmark::State& state, double& best, const Body& body) {
  const double count = static_cast<double>(points().x.size());
  for (auto _ : state) {
    const double begin = thread_seconds();
    body();
    best = std::max(best, count / (thread_seconds() - begin));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}

template <class Module>
void libnoise_points(benchmark::State& state, Module& module, double& best) {
  module.SetOctaveCount(kOctaves);
  module.SetFrequency(kFrequency);
  const Points& p = points();
  measure(state, best, [&] {
    double sum = 0;
    for (std::size_t i = 0; i < p.x.size(); ++i) sum += module.GetValue(p.x[i], p.y[i], p.z[i]);
    benchmark::DoNotOptimize(sum);
  });
}

void libnoise_perlin(benchmark::State& state) {
  ::noise::module::Perlin module;
  libnoise_points(state, module, g_libnoise[kPerlin]);
}

void libnoise_ridged(benchmark::State& state) {
  ::noise::module::RidgedMulti module;
  libnoise_points(state, module, g_libnoise[kRidged]);
}

noise::Program program(Subject subject) {
  noise::Graph graph;
  const noise::Fractal fractal{.seed = 1, .frequency = kFrequency, .octaves = kOctaves};
  const noise::Node root = subject == kPerlin ? graph.fbm(fractal) : graph.ridged_multifractal(fractal);
  return {graph, root};
}

// Restricts Highway to one instruction set (0: the best) while it lives.
struct Target {
  explicit Target(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~Target() { hwy::SetSupportedTargetsForTest(0); }
};

void noise_points(benchmark::State& state, Subject subject, std::int64_t target) {
  const Target forced(target);
  const noise::Program fractal = program(subject);
  const Points& p = points();
  std::vector<float> out(p.x.size());
  double best = 0;
  measure(state, best, [&] {
    fractal.points(p.x, p.y, p.z, out);
    benchmark::DoNotOptimize(out.data());
  });
  state.SetLabel(std::string(noise::simd_name()));
  state.counters["times_libnoise"] = best / g_libnoise[subject];
}

void noise_columns(benchmark::State& state, Subject subject, std::int64_t target) {
  const Target forced(target);
  const noise::Program fractal = program(subject);
  std::vector<float> out(512);
  float x = 0;
  for (auto _ : state) {
    fractal.column({x += 0.25F, 1.0F, 0.0F, 0.25F}, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(512 * state.iterations());
  state.SetLabel(std::string(noise::simd_name()));
}

// All n³ samples, on all cores; cpu_s is the time of all threads together.
void cave_terrain(benchmark::State& state, std::int64_t target) {
  const Target forced(target);
  const Solid solid = noise::cave_terrain();
  const auto n = static_cast<std::size_t>(state.range(0));
  const float d = solid.bounds.high.x / static_cast<float>(n);
  std::vector<Material> cells(n * n * n);
  const std::clock_t begin = std::clock();
  for (auto _ : state) {
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t z) {
      for (std::size_t x = 0; x < n; ++x) {
        solid.column({(static_cast<float>(x) + 0.5F) * d, (static_cast<float>(z) + 0.5F) * d, 0.5F * d, d},
                     std::span(cells).subspan((z * n + x) * n, n));
      }
    });
    benchmark::DoNotOptimize(cells.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(cells.size()) * state.iterations());
  state.counters["cpu_s"] = benchmark::Counter(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
                                               benchmark::Counter::kAvgIterations);
  std::size_t boundaries = 0;
  for (std::size_t i = 1; i < cells.size(); ++i) boundaries += i % n != 0 && cells[i] != cells[i - 1];
  state.counters["boundaries_a_column"] = static_cast<double>(boundaries) / static_cast<double>(n * n);
  state.SetLabel(std::string(noise::simd_name()));
}

BENCHMARK(libnoise_perlin);
BENCHMARK(libnoise_ridged);
#define NOISE_ON(name, target)                                      \
  BENCHMARK_CAPTURE(noise_points, perlin_##name, kPerlin, target);  \
  BENCHMARK_CAPTURE(noise_points, ridged_##name, kRidged, target);  \
  BENCHMARK_CAPTURE(noise_columns, perlin_##name, kPerlin, target); \
  BENCHMARK_CAPTURE(noise_columns, ridged_##name, kRidged, target); \
  BENCHMARK_CAPTURE(cave_terrain, name, target)                     \
      ->RangeMultiplier(2)                                          \
      ->Range(64, 512)                                              \
      ->Unit(benchmark::kMillisecond)                               \
      ->UseRealTime()
NOISE_ON(best, 0);
#if HWY_ARCH_X86
NOISE_ON(avx2, HWY_AVX2);
#endif

}  // namespace
}  // namespace terrabench
