// Layered stacks compared with OpenVDB's accessors and mesher (the `voxel` representation) and the dense
// grid, on one cave-like solid that is very cheap to sample. Rates are items per second of one thread, except
// for build and mesh.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "representations/layered_stack/components.h"
#include "representations/layered_stack/layered_stack.h"
#include "representations/representation.h"

namespace {

using namespace terrabench;

constexpr std::array<std::string_view, 3> kNames = {"layered_stack", "voxel", "dense_voxel"};

// Ground and tunnels from per-column phases, so that a sample costs a few additions and the source hardly
// counts.
TerrainSource cheap_caves() {
  TerrainSource source;
  source.name = "cheap caves";
  source.solid =
      Solid{{{0, 0, 0}, {1, 1, 1}}, "", [](const ColumnSamples& at, std::span<Material> out) {
              constexpr float kTurn = 2 * std::numbers::pi_v<float>;
              const float ground = 0.6F + 0.15F * std::sin(kTurn * 2 * at.x) * std::cos(kTurn * 3 * at.z);
              const float first = 0.2F + 0.1F * std::sin(kTurn * (3 * at.x + at.z));
              const float second = 0.4F + 0.08F * std::cos(kTurn * (2 * at.x - 3 * at.z));
              const auto level = [&](float y) {
                return static_cast<std::size_t>(
                    std::clamp((y - at.y0) / at.dy, 0.0F, static_cast<float>(out.size())));
              };
              std::fill(out.begin(), out.end(), Material::kAir);
              std::fill(out.begin(), out.begin() + static_cast<long>(level(ground)), Material::kBedrock);
              for (const float hole : {first, second}) {
                std::fill(out.begin() + static_cast<long>(level(hole)),
                          out.begin() + static_cast<long>(level(hole + 0.06F)), Material::kAir);
              }
            }};
  return source;
}

std::unique_ptr<Representation> build(std::string_view name, std::int64_t n) {
  static const TerrainSource source = cheap_caves();
  const RepresentationType& type = representation(name);
  Parameters parameters(type.parameters);
  parameters.set("resolution", n);
  Progress progress;
  return type.build(source, parameters, progress);
}

const Representation& built(std::int64_t which, std::int64_t n) {
  static std::map<std::pair<std::int64_t, std::int64_t>, std::unique_ptr<Representation>> all;
  auto& one = all[{which, n}];
  if (!one) one = build(kNames[static_cast<std::size_t>(which)], n);
  return *one;
}

constexpr std::size_t kBatch = 1 << 16, kQueries = 1 << 22;

std::vector<float> random_coordinates(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> all(kQueries);
  for (float& v : all) v = unit(random);
  return all;
}

const std::array<std::vector<float>, 3>& positions() {
  static const std::array<std::vector<float>, 3> all = {random_coordinates(1), random_coordinates(2),
                                                        random_coordinates(3)};
  return all;
}

void point_queries(benchmark::State& state) {
  const Representation& structure = built(state.range(0), state.range(1));
  std::vector<Material> out(kBatch);
  std::size_t at = 0;
  for (auto _ : state) {
    const auto part = [&](int axis) {
      return std::span(positions()[static_cast<std::size_t>(axis)]).subspan(at, kBatch);
    };
    structure.materials({part(0), part(1), part(2)}, out);
    benchmark::DoNotOptimize(out.data());
    at = (at + kBatch) % kQueries;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
  state.SetLabel(std::string(kNames[static_cast<std::size_t>(state.range(0))]));
}

void column_queries(benchmark::State& state) {
  const Representation& structure = built(state.range(0), state.range(1));
  SpanSink sink;
  std::size_t at = 0;
  for (auto _ : state) {
    sink.clear();
    structure.spans(
        {std::span(positions()[0]).subspan(at, kBatch), std::span(positions()[1]).subspan(at, kBatch)}, sink);
    benchmark::DoNotOptimize(sink.all().data());
    at = (at + kBatch) % kQueries;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
  state.SetLabel(std::string(kNames[static_cast<std::size_t>(state.range(0))]));
}

void single_edits(benchmark::State& state) {
  const auto structure = build(kNames[static_cast<std::size_t>(state.range(0))], state.range(1));
  std::size_t at = 0;
  for (auto _ : state) {
    const float x = positions()[0][at], z = positions()[1][at], bottom = 0.9F * positions()[2][at];
    const Span span = {bottom, bottom + 0.05F, at % 2 == 0 ? Material::kAir : Material::kBedrock};
    structure->edit({std::span(&x, 1), std::span(&z, 1)}, std::span(&span, 1));
    at = (at + 1) % kQueries;
  }
  state.SetItemsProcessed(state.iterations());
  state.SetLabel(std::string(kNames[static_cast<std::size_t>(state.range(0))]));
}

void builds(benchmark::State& state) {
  const std::string_view name = kNames[static_cast<std::size_t>(state.range(0))];
  for (auto _ : state) benchmark::DoNotOptimize(build(name, state.range(1)));
  const auto structure = build(name, state.range(1));
  const double columns = static_cast<double>(state.range(1) * state.range(1));
  state.counters["bytes/column"] = static_cast<double>(structure->memory().total()) / columns;
  state.SetItemsProcessed(state.iterations() * state.range(1) * state.range(1));
  state.SetLabel(std::string(name));
}

// Only fills each column's samples: the difference to `builds` is the cost of the structure.
void sampling(benchmark::State& state) {
  const TerrainSource source = cheap_caves();
  const auto n = static_cast<std::size_t>(state.range(0));
  const float cell = 1 / static_cast<float>(n);
  std::vector<Material> column(n);
  for (auto _ : state) {
    for (std::size_t c = 0; c < n * n; ++c) {
      source.solid->column({(static_cast<float>(c % n) + 0.5F) * cell,
                            (static_cast<float>(c / n) + 0.5F) * cell, 0.5F * cell, cell},
                           column);
      benchmark::DoNotOptimize(column.data());
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
}

void meshes(benchmark::State& state) {
  const Representation& structure = built(state.range(0), state.range(1));
  std::size_t triangles = 0;
  for (auto _ : state) triangles = structure.mesh({}).triangles();
  state.counters["triangles"] = static_cast<double>(triangles);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles));
  state.SetLabel(std::string(kNames[static_cast<std::size_t>(state.range(0))]));
}

void components(benchmark::State& state) {
  const auto& stack = dynamic_cast<const LayeredStack&>(built(0, state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(find_components(stack));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stack.runs()));
}

BENCHMARK(point_queries)->ArgsProduct({{0, 1, 2}, {128, 512}});
BENCHMARK(column_queries)->ArgsProduct({{0, 1, 2}, {128, 512}});
BENCHMARK(single_edits)->ArgsProduct({{0, 1, 2}, {256}});
BENCHMARK(sampling)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(builds)->ArgsProduct({{0, 1, 2}, {128, 512}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(meshes)->ArgsProduct({{0, 1, 2}, {128, 256}})->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(components)->Arg(128)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
