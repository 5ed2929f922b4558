// Table 1 (memory) and Table 2 (generation time) of "hybrid", and what the reuse of a fractal saves
// (§3.1.3.3).
#include <fmt/format.h>

#include <array>
#include <random>

#include "experiments/build_at.h"
#include "experiments/experiment.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/layered_stack/layered_stack.h"
#include "terrain/memory.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array kSizeSpecs{
    ParameterSpec{"n", std::int64_t{128}, "cells", "cells along each side of the cube", 2, 4096},
};

std::vector<Case> size_cases(std::initializer_list<std::int64_t> sizes) {
  std::vector<Case> cases;
  for (const std::int64_t n : sizes) {
    cases.push_back({fmt::format("n={}", n), {kSizeSpecs, {{"n", n}}}});
  }
  return cases;
}

struct Layer {
  float top;  // metres
  Material material;
};

// A structure's bytes, by its own accounting and by the allocator.
struct Bytes {
  Memory memory;
  std::int64_t heap = 0;
};

// The share of columns with more than three layers, which three layers of 8 B could not hold.
double share_over_three(const LayeredStack& stack) {
  const ColumnGrid& grid = stack.grid();
  double over = 0;
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) over += stack.column(i, j).count > 3;
  }
  return over / static_cast<double>(grid.columns());
}

Bytes bytes_of(std::string_view name, const TerrainSource& source, std::int64_t n, Progress& progress) {
  auto built = build_at_resolution(name, source, n, progress);
  const Memory memory = built->memory();
  return {memory, destroy_and_count(std::move(built))};
}

// A layout that agrees with the paper's number, which describes none: an array with one std::vector of layers
// per column. That number is the array alone, 24 bytes per column; it leaves out the heap blocks that hold
// the layers, which the heap bytes here include. Three layers of 8 B in each column would take 24 bytes as
// well.
Bytes paper_layout(const TerrainSource& source, std::int64_t n, Progress& progress) {
  const std::unique_ptr<LayeredStack> built = stack_at_resolution(source, n, progress);
  const LayeredStack& stack = *built;
  const ColumnGrid& grid = stack.grid();
  const HeapScope scope;
  std::vector<std::vector<Layer>> columns(grid.columns());
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      const ColumnRuns runs = stack.column(i, j);
      std::vector<Layer>& column = columns[grid.index(i, j)];
      column.reserve(runs.count);
      for (std::size_t k = 0; k < runs.count; ++k) {
        column.push_back({grid.edge_y(runs.tops[k]), runs.materials[k]});
      }
    }
  }
  const std::size_t array = columns.size() * sizeof columns[0];
  return {{array, 0, heap_bytes(columns.data()) - array}, scope.held()};
}

// Queries per second of one thread at random positions: the material of a point, all spans of a column.
void measure_queries(const Representation& structure, const Bounds& bounds, Recorder& recorder) {
  constexpr std::size_t kQueries = 1 << 20;
  std::mt19937 random(1);
  const auto positions = [&](float low, float high) {
    std::uniform_real_distribution<float> position(low, high);
    std::vector<float> all(kQueries);
    for (float& at : all) at = position(random);
    return all;
  };
  const std::vector<float> x = positions(bounds.low.x, bounds.high.x),
                           y = positions(bounds.low.y, bounds.high.y);
  const std::vector<float> z = positions(bounds.low.z, bounds.high.z);
  std::vector<Material> materials(kQueries);
  SpanSink sink;
  Samples rates;
  rates.add("point_queries_per_second", "1/s", [&] {
    return kQueries / seconds([&] { structure.materials({x, y, z}, materials); });
  });
  rates.add("column_queries_per_second", "1/s", [&] {
    sink.clear();
    return kQueries / seconds([&] { structure.spans({x, z}, sink); });
  });
  rates.take(recorder);
}

std::vector<Case> table1_cases(const RunOptions& options) {
  return options.profile == Profile::kPaper ? size_cases({128, 256, 512}) : size_cases({64, 128, 256});
}

void measure_table1(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const auto columns = static_cast<double>(n * n);
  const TerrainSource source = recorder.terrain(noise::cave_source({.seed = options.seed}));
  const Bytes paper = paper_layout(source, n, progress);
  const std::unique_ptr<LayeredStack> built = stack_at_resolution(source, n, progress);
  recorder.add("columns_over_three_layers", "", share_over_three(*built));
  measure_queries(*built, source.bounds(), recorder);
  const Bytes stack = bytes_of("layered_stack", source, n, progress);
  const Bytes dense = bytes_of("dense_voxel", source, n, progress);
  const Bytes openvdb = bytes_of("voxel", source, n, progress);

  const auto paper_bytes = static_cast<double>(paper.memory.payload);
  recorder.add("paper_stack_bytes", "B", paper_bytes);
  recorder.add("paper_layout_heap_bytes", "B", paper.heap);
  recorder.add("dense_voxel_bytes", "B", dense.memory.payload);
  recorder.add("voxel_to_stack_ratio", "", static_cast<double>(dense.memory.payload) / paper_bytes);
  recorder.add("stack_bytes", "B", stack.memory.total());
  recorder.add("stack_heap_bytes", "B", stack.heap);
  recorder.add("stack_bytes_per_column", "B", static_cast<double>(stack.heap) / columns);
  recorder.add("dense_heap_bytes", "B", dense.heap);
  recorder.add("openvdb_bytes", "B", openvdb.memory.total());
  recorder.add("openvdb_heap_bytes", "B", openvdb.heap);
}

constexpr std::array kTimeSpecs{
    kSizeSpecs[0],
    ParameterSpec{"every_cell", false, "",
                  "evaluate every fractal in every cell, as the paper's program does"},
};

// The paper's work, and ours, which skips what bounds decide.
std::vector<Case> table2_cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const bool every_cell : {true, false}) {
    for (const std::int64_t n : {64, 128, 256, 512}) {
      if (n == 512 && options.profile != Profile::kPaper) continue;
      cases.push_back({fmt::format("n={}{}", n, every_cell ? "/every-cell" : ""),
                       {kTimeSpecs, {{"n", n}, {"every_cell", every_cell}}}});
    }
  }
  return cases;
}

void measure_table2(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const bool every_cell = at.parameters.flag("every_cell");
  const TerrainSource source =
      recorder.terrain(noise::cave_source({.seed = options.seed, .every_cell = every_cell}));
  build_at_resolution("layered_stack", source, std::min<std::int64_t>(n, 64),
                      progress);  // warm caches, pool and clock
  for (Repetitions builds; builds.more();) {
    const double time =
        seconds_to_make([&] { return build_at_resolution("layered_stack", source, n, progress); });
    builds.add(time);
    recorder.add("generation_time", "s", time);
    recorder.add("samples_per_second", "1/s", static_cast<double>(n * n * n) / time);
  }
}

std::vector<Case> reuse_cases(const RunOptions&) { return size_cases({128}); }

// One fractal distorts both cave maps, or each has its own. The ratios are those of one turn.
void measure_reuse(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const auto terrain = [&](bool shared) {
    return noise::cave_source({.seed = options.seed, .share_roughness = shared, .every_cell = true});
  };
  const TerrainSource five = recorder.terrain(terrain(true)), six = terrain(false);
  const auto time = [&](const TerrainSource& source) {
    return seconds([&] { build_at_resolution("layered_stack", source, n, progress); });
  };
  time(five);  // warm caches, pool and clock
  for (Repetitions turns; turns.more();) {
    const double shared = time(five), own = time(six);
    turns.add(shared + own);
    recorder.add("time_five", "s", shared);
    recorder.add("time_six", "s", own);
    recorder.add_varying("six_to_five", "", own / shared);
  }
}

}  // namespace

extern const Experiment kTable1{"hybrid.table1", "Table 1: memory of the discrete data structure",
                                kSizeSpecs,      table1_cases,
                                measure_table1,  Experiment::kTimed};
extern const Experiment kTable2{"hybrid.table2", "Table 2: terrain generation times",
                                kTimeSpecs,      table2_cases,
                                measure_table2,  Experiment::kTimed};
extern const Experiment kReuse{"hybrid.reuse", "§3.1.3.3: a fractal that is used twice, or a sixth",
                               kSizeSpecs,     reuse_cases,
                               measure_reuse,  Experiment::kTimed};

}  // namespace terrabench::hybrid
