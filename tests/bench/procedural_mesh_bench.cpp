// Procedural meshes as terrain: columns a second of one thread, beside the heightmap of the same ground, and
// what building costs.
#include <benchmark/benchmark.h>

#include <array>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "representations/procedural_mesh/procedural_mesh.h"
#include "tests/bench/mountains.h"

namespace {

using namespace terrabench;

constexpr std::array<const char*, 2> kTypes = {"procedural_mesh", "heightmap"};
constexpr std::array<const char*, 3> kModels = {"fractal_plane", "chair", "cactus"};
constexpr std::size_t kBatch = 1 << 16, kQueries = 1 << 21;

std::unique_ptr<Representation> plane(std::size_t type, int side) {
  const RepresentationType& chosen = representation(kTypes[type]);
  Progress progress;
  return chosen.build(source_of("mountains", mountains(side)), Parameters(chosen.parameters), progress);
}

// Columns at random, or along rows as a sweep over the ground asks for them.
struct Queries {
  std::vector<float> x, z;
  Queries(const Bounds& bounds, bool random) : x(kQueries), z(kQueries) {
    std::mt19937 bits(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const glm::vec3 size = bounds.size();
    for (std::size_t i = 0; i < kQueries; ++i) {
      const float u = random ? unit(bits) : (static_cast<float>(i % 2048) + 0.5F) / 2048;
      const float v = random ? unit(bits) : (static_cast<float>(i / 2048) + 0.5F) / 1024;
      x[i] = bounds.low.x + u * size.x;
      z[i] = bounds.low.z + v * size.z;
    }
  }
};

void ask(benchmark::State& state, const Representation& structure, bool random) {
  const Queries queries(structure.bounds(), random);
  SpanSink sink;
  std::size_t at = 0;
  for (auto _ : state) {
    sink.clear();
    structure.spans({std::span(queries.x).subspan(at, kBatch), std::span(queries.z).subspan(at, kBatch)},
                    sink);
    benchmark::DoNotOptimize(sink.all().data());
    at = (at + kBatch) % kQueries;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
}

void plane_columns(benchmark::State& state) {
  const auto type = static_cast<std::size_t>(state.range(0));
  ask(state, *plane(type, static_cast<int>(state.range(1))), state.range(2) != 0);
  state.SetLabel(std::string(kTypes[type]) + (state.range(2) != 0 ? ", random" : ", in rows"));
}

void model_columns(benchmark::State& state) {
  const char* const name = kModels[static_cast<std::size_t>(state.range(0))];
  const TerrainSource source = model_source(growing::model_text(name), name);
  ask(state, *source.solid->column.target<MeshColumns>()->mesh, true);
  state.SetLabel(name);
}

void builds(benchmark::State& state) {
  const RepresentationType& type = representation("procedural_mesh");
  const TerrainSource source = source_of("mountains", mountains(static_cast<int>(state.range(0))));
  std::unique_ptr<Representation> built;
  for (auto _ : state) {
    Progress progress;
    built = type.build(source, Parameters(type.parameters), progress);
  }
  const auto samples = static_cast<double>(source.heights->heights.size());
  const auto& mesh = dynamic_cast<const ProceduralMesh&>(*built);
  state.counters["bytes/sample"] = static_cast<double>(built->memory().total()) / samples;
  state.counters["described"] = static_cast<double>(mesh.description_bytes()) / samples;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples));
}

BENCHMARK(plane_columns)->ArgsProduct({{0, 1}, {513, 2049}, {0, 1}});
BENCHMARK(model_columns)->DenseRange(0, 2);
BENCHMARK(builds)->Arg(513)->Arg(2049)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
