// ROAM on 4097² synthetic mountains, 30 m between samples: building the wedgies, refining from scratch, and
// walking with a limit on triangles. The cost of a frame should be proportional to its changes, not to its
// triangles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <optional>

#include "lod/roam/roam.h"
#include "tests/bench/mountains.h"

namespace {

using namespace terrabench;

const Heightfield& ground() {
  static const Heightfield field = [] {
    Heightfield mountain = mountains(4097);
    mountain.cell_x = mountain.cell_z = 30;
    return mountain;
  }();
  return field;
}

// 1.8 m above ground, on a wide circle, looking ahead.
View walk(double metres) {
  const double radius = 20000, angle = metres / radius;
  const auto at = [&](double turn) {
    const auto x = static_cast<float>(60000 + radius * std::cos(turn));
    const auto z = static_cast<float>(60000 + radius * std::sin(turn));
    return glm::vec3(x, ground().sample(x, z) + 1.8F, z);
  };
  View view;
  view.eye = at(angle);
  const glm::vec3 ahead = at(angle + 0.01);
  view.target = {ahead.x, view.eye.y, ahead.z};
  view.far = 200000;
  return view;
}

View turn(double angle) {
  View view = walk(0);
  view.target = view.eye + glm::vec3(std::cos(angle), 0, std::sin(angle));
  return view;
}

RoamOptions limited_to(std::int64_t triangles) {
  return {.max_error = 0.01, .triangles = static_cast<std::size_t>(triangles)};
}

void build(benchmark::State& state) {
  Progress progress;
  ground();
  for (auto _ : state) {
    benchmark::DoNotOptimize(std::make_unique<Roam>(ground(), RoamOptions{}, progress)->memory());
  }
}
BENCHMARK(build)->Unit(benchmark::kMillisecond)->UseRealTime();

void from_cold(benchmark::State& state) {
  Progress progress;
  double changes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::optional<Roam> roam(std::in_place, ground(), limited_to(state.range(0)), progress);
    state.ResumeTiming();
    changes += static_cast<double>(roam->update(walk(0)).stats.changes);
    state.PauseTiming();
    roam.reset();
    state.ResumeTiming();
  }
  state.counters["changes/s"] = benchmark::Counter(changes, benchmark::Counter::kIsRate);
}
BENCHMARK(from_cold)->Arg(20000)->Arg(80000)->Arg(320000)->Unit(benchmark::kMillisecond)->Iterations(60);

template <class Path>
void frames(benchmark::State& state, const RoamOptions& options, Path path) {
  Progress progress;
  Roam roam(ground(), options, progress);
  roam.update(path(0));
  double changes = 0, bytes = 0, triangles = 0;
  int frame = 0;
  for (auto _ : state) {
    const FrameStats& stats = roam.update(path(++frame)).stats;
    changes += static_cast<double>(stats.changes);
    bytes += static_cast<double>(stats.bytes_uploaded);
    triangles += static_cast<double>(stats.triangles);
  }
  const auto average = benchmark::Counter::kAvgIterations;
  state.counters["changes"] = benchmark::Counter(changes, average);
  state.counters["bytes"] = benchmark::Counter(bytes, average);
  state.counters["drawn"] = benchmark::Counter(triangles, average);
}

// 28 mm per frame is 6 km/h at 60 frames per second. Ten times the speed gives ten times the changes and the
// cost; at rest a frame costs only the check for motion.
void walking(benchmark::State& state) {
  const double step = 1e-3 * static_cast<double>(state.range(1));
  frames(state, limited_to(state.range(0)), [&](int frame) { return walk(step * frame); });
}
void speeds(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"triangles", "mm"})->Unit(benchmark::kMicrosecond)->Iterations(1000);
  for (const int triangles : {20000, 80000, 320000}) {
    for (const int mm : {0, 28, 280, 2800}) benchmark->Args({triangles, mm});
  }
}
BENCHMARK(walking)->Apply(speeds);

// 100 m/s at 60 frames per second.
void flying(benchmark::State& state) {
  frames(state, limited_to(state.range(0)), [](int frame) {
    View view = walk(1.67 * frame);
    view.eye.y += 300;
    view.target.y += 280;
    return view;
  });
}
BENCHMARK(flying)->Arg(20000)->Arg(80000)->Arg(320000)->Unit(benchmark::kMicrosecond)->Iterations(1000);

// One degree per frame, on the spot.
void turning(benchmark::State& state) {
  frames(state, limited_to(state.range(0)), [](int frame) { return turn(0.0175 * frame); });
}
BENCHMARK(turning)->Arg(20000)->Arg(80000)->Arg(320000)->Unit(benchmark::kMicrosecond)->Iterations(360);

// By max_error in pixels, without a limit on triangles.
void walking_at_error(benchmark::State& state) {
  frames(state, {.max_error = static_cast<double>(state.range(0))},
         [](int frame) { return walk(0.028 * frame); });
}
BENCHMARK(walking_at_error)->Arg(1)->Arg(4)->Unit(benchmark::kMicrosecond)->Iterations(1000);

}  // namespace
