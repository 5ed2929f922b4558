// Table 1 (memory) and Table 2 (generation time) of "hybrid".
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <memory>

#include "experiments/hybrid/cave_source.h"
#include "experiments/hybrid/hybrid.h"
#include "terrain/memory.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array kSizeSpecs{
    ParameterSpec{"n", std::int64_t{128}, "cells", "cells along each side of the cube", 2, 4096},
};

std::vector<Case> size_cases(std::initializer_list<std::int64_t> sizes) {
  std::vector<Case> cases;
  for (const std::int64_t n : sizes) {
    Case& added = cases.emplace_back(Case{fmt::format("n={}", n), Parameters(kSizeParameters), ""});
    added.parameters.set("n", n);
  }
  return cases;
}

noise::CaveOptions seeded(const RunOptions& options) {
  noise::CaveOptions terrain;
  terrain.seed = options.seed;
  return terrain;
}

// A structure's bytes twice: as it accounts for them itself and as the allocator saw them.
struct Bytes {
  Memory memory;
  std::int64_t heap = 0;
};

Bytes bytes_of(std::string_view name, const TerrainSource& source, std::int64_t n, Progress& progress) {
  auto built = build_at_resolution(name, source, n, progress);
  const Memory memory = built->memory();
  return {memory, destroy_and_count(std::move(built))};
}

}  // namespace

constinit const std::span<const ParameterSpec> kSizeParameters = kSizeSpecs;

std::vector<Case> table1_cases(const RunOptions& options) {
  return options.profile == Profile::kPaper ? size_cases({128, 256, 512}) : size_cases({64, 128, 256});
}

void measure_table1(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const auto columns = static_cast<double>(n * n);
  const TerrainSource source = cave_source(seeded(options));
  recorder.terrain(source);
  // 24 bytes a column are what one std::vector object takes, whatever it holds: the paper counts no more than
  // that.
  const double paper_bytes = columns * sizeof(std::vector<Span>);
  const Bytes stack = bytes_of("layered_stack", source, n, progress);
  const Bytes dense = bytes_of("dense_voxel", source, n, progress);
  const Bytes openvdb = bytes_of("voxel", source, n, progress);

  recorder.add("paper_stack_bytes", "B", paper_bytes);
  recorder.add("dense_voxel_bytes", "B", static_cast<double>(dense.memory.payload));
  recorder.add("voxel_to_stack_ratio", "", static_cast<double>(dense.memory.payload) / paper_bytes);
  recorder.add("stack_bytes", "B", static_cast<double>(stack.memory.total()));
  recorder.add("stack_heap_bytes", "B", static_cast<double>(stack.heap));
  recorder.add("stack_bytes_per_column", "B", static_cast<double>(stack.heap) / columns);
  recorder.add("dense_heap_bytes", "B", static_cast<double>(dense.heap));
  recorder.add("openvdb_bytes", "B", static_cast<double>(openvdb.memory.total()));
  recorder.add("openvdb_heap_bytes", "B", static_cast<double>(openvdb.heap));
}

std::vector<Case> table2_cases(const RunOptions& options) {
  return options.profile == Profile::kPaper ? size_cases({64, 128, 256, 512}) : size_cases({64, 128, 256});
}

void measure_table2(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const TerrainSource source = cave_source(seeded(options));
  recorder.terrain(source);
  build_at_resolution("layered_stack", source, std::min<std::int64_t>(n, 64),
                      progress);  // warm caches, pool and clock
  const int samples = n >= 512 ? 3 : n >= 256 ? 5 : 11;
  for (int i = 0; i < samples; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const auto stack = build_at_resolution("layered_stack", source, n, progress);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    recorder.add("generation_time", "s", seconds.count());
    recorder.add("samples_per_second", "1/s", static_cast<double>(n * n * n) / seconds.count());
  }
}

}  // namespace terrabench::hybrid
