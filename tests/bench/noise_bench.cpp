// Noise compared with libnoise on the same fractals and points, and the cave terrain column by column.
// vs_libnoise is the ratio of thread times measured in the same run.
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
enum Where { kScattered, kColumnwise };

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Where noise is sampled: points in random order, or vertical columns of 512
// samples a quarter of a metre apart, as terrains sample it.
struct Points {
  std::vector<float> x, y, z;
};
constexpr std::size_t kColumns = 32, kColumn = 512;
constexpr float kStep = 0.25F;

const Points& scattered() {
  static const Points made = [] {
    Points p;
    std::uint64_t state = 1;
    const auto next = [&] {
      state = state * 6364136223846793005U + 1442695040888963407U;
      return static_cast<float>(state >> 40) * 0x1p-24F * 1000.0F - 500.0F;
    };
    for (std::size_t i = 0; i < kColumns * kColumn; ++i) {
      p.x.push_back(next());
      p.y.push_back(next());
      p.z.push_back(next());
    }
    return p;
  }();
  return made;
}

const Points& columns() {
  static const Points made = [] {
    Points p;
    for (std::size_t i = 0; i < kColumns * kColumn; ++i) {
      p.x.push_back(static_cast<float>(i / kColumn) * kStep);
      p.y.push_back(static_cast<float>(i % kColumn) * kStep);
      p.z.push_back(1.0F);
    }
    return p;
  }();
  return made;
}

struct Case {
  Subject subject;
  Where where;
};

// Libnoise's rates by subject and place: samples per second of thread time in the fastest iteration, which on
// a busy machine is the least disturbed one.
std::array<std::array<double, 2>, 2> g_libnoise{};

template <class Body>
double measure(benchmark::State& state, const Body& body) {
  constexpr auto kCount = static_cast<double>(kColumns * kColumn);
  double best = 0;
  for (auto _ : state) {
    const double begin = thread_seconds();
    body();
    best = std::max(best, kCount / (thread_seconds() - begin));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kCount) * state.iterations());
  state.counters["fastest"] = benchmark::Counter(best, benchmark::Counter::kDefaults);
  return best;
}

template <class Module>
double measure_libnoise(benchmark::State& state, const Points& p) {
  Module module;
  module.SetOctaveCount(kOctaves);
  module.SetFrequency(kFrequency);
  return measure(state, [&] {
    double sum = 0;
    for (std::size_t i = 0; i < p.x.size(); ++i) sum += module.GetValue(p.x[i], p.y[i], p.z[i]);
    benchmark::DoNotOptimize(sum);
  });
}

void libnoise(benchmark::State& state, Case of) {
  const Points& p = of.where == kScattered ? scattered() : columns();
  g_libnoise[of.subject][of.where] = of.subject == kPerlin
                                         ? measure_libnoise<::noise::module::Perlin>(state, p)
                                         : measure_libnoise<::noise::module::RidgedMulti>(state, p);
}

noise::Program program(Subject subject) {
  noise::Graph graph;
  const noise::Fractal fractal{.seed = 1, .frequency = kFrequency, .octaves = kOctaves};
  const noise::Node root = subject == kPerlin ? graph.fbm(fractal) : graph.ridged_multifractal(fractal);
  return {graph, root};
}

// Restricts Highway to one instruction set (0: the best) during its lifetime.
struct Target {
  explicit Target(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~Target() { hwy::SetSupportedTargetsForTest(0); }
};

void ours(benchmark::State& state, Case of, std::int64_t target) {
  const Target forced(target);
  const noise::Program fractal = program(of.subject);
  std::vector<float> out(kColumns * kColumn);
  const double best = measure(state, [&] {
    if (of.where == kScattered) {
      fractal.points(scattered().x, scattered().y, scattered().z, out);
    } else {
      for (std::size_t i = 0; i < kColumns; ++i) {
        fractal.column({static_cast<float>(i) * kStep, 1.0F, 0.0F, kStep},
                       std::span(out).subspan(i * kColumn, kColumn));
      }
    }
    benchmark::DoNotOptimize(out.data());
  });
  state.SetLabel(std::string(noise::simd_name()));
  state.counters["vs_libnoise"] = best / g_libnoise[of.subject][of.where];
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

constexpr Case kPerlinPoints{kPerlin, kScattered}, kRidgedPoints{kRidged, kScattered};
constexpr Case kPerlinColumns{kPerlin, kColumnwise}, kRidgedColumns{kRidged, kColumnwise};

#define NOISE_ON(name, target)                                            \
  BENCHMARK_CAPTURE(ours, perlin_points_##name, kPerlinPoints, target);   \
  BENCHMARK_CAPTURE(ours, ridged_points_##name, kRidgedPoints, target);   \
  BENCHMARK_CAPTURE(ours, perlin_columns_##name, kPerlinColumns, target); \
  BENCHMARK_CAPTURE(ours, ridged_columns_##name, kRidgedColumns, target); \
  BENCHMARK_CAPTURE(cave_terrain, name, target)                           \
      ->RangeMultiplier(2)                                                \
      ->Range(64, 512)                                                    \
      ->Unit(benchmark::kMillisecond)                                     \
      ->UseRealTime()

// libnoise comes first: the ratios need it.
BENCHMARK_CAPTURE(libnoise, perlin_points, kPerlinPoints);
BENCHMARK_CAPTURE(libnoise, ridged_points, kRidgedPoints);
BENCHMARK_CAPTURE(libnoise, perlin_columns, kPerlinColumns);
BENCHMARK_CAPTURE(libnoise, ridged_columns, kRidgedColumns);
NOISE_ON(best, 0);
#if HWY_ARCH_X86
NOISE_ON(avx2, HWY_AVX2);
#endif

}  // namespace
}  // namespace terrabench
