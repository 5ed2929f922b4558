// Catmull–Clark refinement of a bumpy grid: building tables, and positions from tables that exist, beside
// OpenSubdiv's evaluators (meshgrow.refinement has OpenMesh's subdivider, too). Rates are vertices of the
// finest level per second. Arguments: quadrilaterals along the side of the base, levels. vs_opensubdiv is the
// ratio of the fastest wall times in the same run, for positions beside its OpenMP evaluator: above 1 we are
// faster.
#include <benchmark/benchmark.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/ompEvaluator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include "representations/procedural_mesh/base_mesh.h"
#include "representations/procedural_mesh/subdivision/subdivide.h"
#include "terrain/memory.h"

namespace {

using namespace terrabench;
using namespace terrabench::subdivision;
namespace Far = OpenSubdiv::Far;
namespace Osd = OpenSubdiv::Osd;

FaceMesh base_of(const benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  FaceMesh mesh = growing::plane(glm::dvec2(n), n, n).mesh;
  mesh.texture.clear();
  for (glm::vec3& p : mesh.positions) p.y = std::sin(p.x * 0.7F) * std::cos(p.z * 0.9F);
  return mesh;
}
int levels_of(const benchmark::State& state) { return static_cast<int>(state.range(1)); }

void count(benchmark::State& state, std::size_t vertices, std::size_t quads) {
  state.counters["quads"] = static_cast<double>(quads);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(vertices));
}
std::size_t quads_of(const benchmark::State& state) {
  return static_cast<std::size_t>(state.range(0) * state.range(0)) << (2 * state.range(1));
}

// Seconds of the fastest turn, by arguments: the least disturbed one on a busy machine.
using Fastest = std::map<std::pair<std::int64_t, std::int64_t>, double>;
Fastest g_opensubdiv_tables, g_opensubdiv_positions;  // of the peers, which run first

template <class Work>
double fastest_of(benchmark::State& state, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void compare(benchmark::State& state, const Fastest& peers, double ours) {
  const auto peer = peers.find({state.range(0), state.range(1)});
  if (peer != peers.end()) state.counters["vs_opensubdiv"] = peer->second / ours;
}

void tables(benchmark::State& state) {
  const FaceMesh base = base_of(state);
  std::size_t vertices = 0;
  const double best = fastest_of(state, [&] {
    const Refinement refinement(base, levels_of(state), {.keep = Keep::kStencils});
    vertices = refinement.topology(refinement.levels()).vertices;
  });
  count(state, vertices, quads_of(state));
  compare(state, g_opensubdiv_tables, best);
}

void positions(benchmark::State& state) {
  const FaceMesh base = base_of(state);
  const int levels = levels_of(state);
  const Refinement refinement(base, levels, {.keep = Keep::kStencils});
  std::vector<std::vector<glm::vec3>> points{base.positions};
  for (int l = 1; l <= levels; ++l) points.emplace_back(refinement.topology(l).vertices);
  const double best = fastest_of(state, [&] {
    for (int l = 0; l < levels; ++l) {
      const auto at = static_cast<std::size_t>(l);
      place_standard<glm::vec3>(refinement.topology(l), refinement.stencils(l), points[at], points[at + 1]);
    }
    benchmark::ClobberMemory();
  });
  count(state, points.back().size(), quads_of(state));
  compare(state, g_opensubdiv_positions, best);
}

// Everything, from a FaceMesh to a FaceMesh, and its peak memory over the bytes of the result.
void whole(benchmark::State& state) {
  const FaceMesh base = base_of(state);
  const std::vector<PlacementRule> rules(static_cast<std::size_t>(levels_of(state)));
  std::size_t vertices = 0;
  double peak = 0, bytes = 1;
  for (auto _ : state) {
    const std::int64_t before = HeapCounter::live();
    HeapCounter::reset_peak();
    const FaceMesh mesh = subdivide(base, rules);
    peak = static_cast<double>(HeapCounter::peak() - before);
    bytes = static_cast<double>(mesh.positions.size() * sizeof(glm::vec3) + mesh.corners.size() * 4);
    vertices = mesh.positions.size();
  }
  count(state, vertices, quads_of(state));
  state.counters["peak/mesh"] = peak / bytes;
}

std::unique_ptr<Far::TopologyRefiner> refine_by_opensubdiv(const FaceMesh& base, int levels) {
  std::vector<int> sizes(base.faces(), 4), corners(base.corners.begin(), base.corners.end());
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(base.positions.size());
  d.numFaces = static_cast<int>(sizes.size());
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = corners.data();
  OpenSubdiv::Sdc::Options options;
  options.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(d, Factory::Options(OpenSubdiv::Sdc::SCHEME_CATMARK, options)));
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  return refiner;
}

std::unique_ptr<const Far::StencilTable> stencils_of(const Far::TopologyRefiner& refiner) {
  Far::StencilTableFactory::Options options;
  options.generateIntermediateLevels = false;  // the finest level from the base: one pass
  options.generateOffsets = true;
  return std::unique_ptr<const Far::StencilTable>(Far::StencilTableFactory::Create(refiner, options));
}

void opensubdiv_tables(benchmark::State& state) {
  const FaceMesh base = base_of(state);
  std::size_t vertices = 0;
  g_opensubdiv_tables[{state.range(0), state.range(1)}] = fastest_of(state, [&] {
    const auto refiner = refine_by_opensubdiv(base, levels_of(state));
    vertices = static_cast<std::size_t>(stencils_of(*refiner)->GetNumStencils());
  });
  count(state, vertices, quads_of(state));
}

template <class Evaluator>
void opensubdiv_positions(benchmark::State& state) {
  const FaceMesh base = base_of(state);
  const auto table = stencils_of(*refine_by_opensubdiv(base, levels_of(state)));
  std::vector<glm::vec3> out(static_cast<std::size_t>(table->GetNumStencils()));
  const Osd::BufferDescriptor vec3(0, 3, 3);
  const double best = fastest_of(state, [&] {
    Evaluator::EvalStencils(&base.positions[0].x, vec3, &out[0].x, vec3, table->GetSizes().data(),
                            table->GetOffsets().data(), table->GetControlIndices().data(),
                            table->GetWeights().data(), 0, table->GetNumStencils());
    benchmark::ClobberMemory();
  });
  if constexpr (std::is_same_v<Evaluator, Osd::OmpEvaluator>) {
    g_opensubdiv_positions[{state.range(0), state.range(1)}] = best;
  }
  count(state, out.size(), quads_of(state));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({200, 2})->Args({100, 4})->Args({1600, 1})->Args({50, 6});
  bench->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}
BENCHMARK(opensubdiv_positions<Osd::CpuEvaluator>)->Apply(sizes);
BENCHMARK(opensubdiv_positions<Osd::OmpEvaluator>)->Apply(sizes);
BENCHMARK(positions)->Apply(sizes);
BENCHMARK(opensubdiv_tables)->Apply(sizes);
BENCHMARK(tables)->Apply(sizes);
BENCHMARK(whole)->Apply(sizes);

}  // namespace
