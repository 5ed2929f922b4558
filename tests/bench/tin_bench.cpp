// Greedy insertion at 4096² of mirrored tiles of a real DEM, queries at random places, and edits. hmm
// (github.com/fogleman/hmm), which inserts one sample at a time on one thread, reports 0.52 M vertices from
// 4745² samples in 4.9 s: 0.11 M/s.
#include <benchmark/benchmark.h>

#include <random>

#include "representations/edit_tools.h"
#include "representations/tin/tin.h"

namespace {

using namespace terrabench;

Heightfield tiled(int size) {
  const Heightfield tile = *open_terrain("jacksboro").heights;
  Heightfield field = Heightfield::zeros(size, size, tile.cell_x, tile.cell_z);
  const auto mirrored = [](int at, int period) {
    const int within = at % (2 * period);
    return within < period ? within : 2 * period - 1 - within;
  };
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) field.at(i, j) = tile.at(mirrored(i, tile.width), mirrored(j, tile.depth));
  }
  return field;
}

void insertion(benchmark::State& state) {
  const Heightfield field = tiled(static_cast<int>(state.range(0)));
  std::size_t vertices = 0;
  for (auto _ : state) {
    Progress progress;
    const auto surface = tin::greedy_insertion(field, static_cast<float>(state.range(1)), progress);
    vertices = surface.heights.size();
  }
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["vertices/s"] =
      benchmark::Counter(static_cast<double>(vertices), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(insertion)
    ->Args({1024, 4})
    ->Args({4096, 16})
    ->Args({4096, 4})
    ->Args({4096, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void queries(benchmark::State& state) {
  const TerrainSource source = source_of("tiled", tiled(4096));
  Parameters parameters(Tin::parameters());
  parameters.set("max_error", static_cast<double>(state.range(0)));
  Progress progress;
  const auto built = Tin::build(source, parameters, progress);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> x(0, source.heights->extent_x()), z(0, source.heights->extent_z());
  std::vector<float> xs(1 << 20), zs(1 << 20);
  for (std::size_t k = 0; k < xs.size(); ++k) {
    xs[k] = x(random);
    zs[k] = z(random);
  }
  SpanSink out;
  for (auto _ : state) {
    out.clear();
    built->spans({xs, zs}, out);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(xs.size()) * state.iterations());
}
BENCHMARK(queries)->Arg(16)->Arg(4)->Unit(benchmark::kMillisecond);

// Spheres dug and filled again at random places of 1024² samples, eight cells in radius.
void edits(benchmark::State& state) {
  const Heightfield field = tiled(1024);
  Parameters parameters(Tin::parameters());
  parameters.set("max_error", static_cast<double>(state.range(0)));
  Progress progress;
  const auto built = Tin::build(source_of("tiled", field), parameters, progress);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> place(10, 1013);
  for (auto _ : state) {
    const int i = place(random), j = place(random);
    const Sphere sphere{
        {static_cast<float>(i) * field.cell_x, field.at(i, j), static_cast<float>(j) * field.cell_z},
        8 * field.cell_x};
    fill_sphere(*built, sphere, Material::kAir);
    fill_sphere(*built, sphere, Material::kBedrock);
  }
  state.SetItemsProcessed(2 * state.iterations());
}
BENCHMARK(edits)->Arg(16)->Arg(4)->Unit(benchmark::kMicrosecond);

}  // namespace
