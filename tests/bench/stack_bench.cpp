// Material stacks beside dense voxels and OpenVDB's of the same cells, on the hybrid paper's noise terrain:
// edits of one column each, which no experiment times, and columns at random positions. vs_dense and
// vs_openvdb are ratios of the fastest times of rounds in which the structures take turns.
#include <benchmark/benchmark.h>

#include <array>
#include <random>

#include "experiments/build_at.h"
#include "experiments/stopwatch.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace {

using namespace terrabench;

constexpr std::array<const char*, 3> kStructures = {"layered_stack", "dense_voxel", "voxel"};
constexpr std::size_t kEdits = 1 << 16, kColumns = 1 << 19;

struct Queries {
  std::vector<float> x, z;
  std::vector<Span> spans;
};

// Spans of up to a sixteenth of the terrain's height, every second one of air.
Queries random_queries(const Bounds& box, std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0, 1);
  Queries queries;
  for (std::size_t k = 0; k < count; ++k) {
    queries.x.push_back(box.low.x + share(random) * box.size().x);
    queries.z.push_back(box.low.z + share(random) * box.size().z);
    const float bottom = box.low.y + share(random) * box.size().y;
    queries.spans.push_back({bottom, bottom + (0.001F + share(random) / 16) * box.size().y,
                             k % 2 == 0 ? Material::kAir : Material::kBedrock});
  }
  return queries;
}

// Times work(structure, queries) for all structures in turn.
template <class Work>
void take_turns(benchmark::State& state, std::size_t count, const Work& work) {
  Progress silent;
  const TerrainSource source = noise::cave_source({});
  const Queries queries = random_queries(source.bounds(), count);
  std::array<std::unique_ptr<Representation>, 3> built;
  for (std::size_t s = 0; s < built.size(); ++s) {
    built[s] = build_at_resolution(kStructures[s], source, state.range(0), silent);
  }
  std::array<double, 3> best{1e30, 1e30, 1e30};
  for (auto _ : state) {
    for (std::size_t s = 0; s < built.size(); ++s) {
      best[s] = std::min(best[s], processor_seconds([&] { work(*built[s], queries); }));
    }
  }
  state.counters["stack_ns"] = best[0] / static_cast<double>(count) * 1e9;
  state.counters["vs_dense"] = best[1] / best[0];
  state.counters["vs_openvdb"] = best[2] / best[0];
}

void edit_one_column(benchmark::State& state) {
  take_turns(state, kEdits, [](Representation& structure, const Queries& queries) {
    for (std::size_t k = 0; k < kEdits; ++k) {
      structure.edit({std::span(&queries.x[k], 1), std::span(&queries.z[k], 1)},
                     std::span(&queries.spans[k], 1));
    }
  });
}
BENCHMARK(edit_one_column)->ArgName("n")->Arg(128)->Arg(512)->Iterations(10)->Unit(benchmark::kMillisecond);

void query_columns(benchmark::State& state) {
  SpanSink sink;
  take_turns(state, kColumns, [&](const Representation& structure, const Queries& queries) {
    sink.clear();
    structure.spans({queries.x, queries.z}, sink);
  });
}
BENCHMARK(query_columns)->ArgName("n")->Arg(128)->Arg(512)->Iterations(30)->Unit(benchmark::kMillisecond);

}  // namespace
