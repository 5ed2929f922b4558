// §3.5 of "hybrid": the height map of the far ground, made from the stacks by both readings of "the sum of
// the heights of all layers".
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiments/build_at.h"
#include "experiments/cases.h"
#include "experiments/hybrid/grounds.h"
#include "representations/layered_stack/height_map.h"

namespace terrabench::hybrid {

namespace {

const std::vector<ParameterSpec>& specs() {
  static const std::vector<ParameterSpec> kSpecs{
      choice("reading", kColumnHeightNames, "height of a column: its top, or the sum of its solid layers"),
      {"n", std::int64_t{128}, "columns", "along each side of the ground", 8, 4096},
      {"finer", std::int64_t{4}, "samples", "of the interpolated map per column", 1, 16},
  };
  return kSpecs;
}

std::vector<Case> cases(const RunOptions& options) {
  const std::int64_t n = options.profile == Profile::kPaper ? 256 : 128;
  std::vector<Case> all = cases_by("reading", specs(), {{"n", n}});
  for (Case& each : all) each.terrain = "caves";
  return all;
}

// What lies over each column, asked of the representation and not of the map's own code.
struct Tops {
  std::vector<float> top;      // metres
  std::vector<float> air;      // metres of it below the top
  std::vector<char> has_cave;  // some air below the top
};

Tops tops_of(const LayeredStack& stack) {
  const ColumnGrid& grid = stack.grid();
  std::vector<float> x, z;
  for (int j = 0; j < grid.depth; ++j) {
    for (int i = 0; i < grid.width; ++i) {
      x.push_back(grid.centre_x(i));
      z.push_back(grid.centre_z(j));
    }
  }
  SpanSink sink;
  stack.spans({x, z}, sink);
  Tops tops;
  for (std::size_t c = 0; c < sink.columns(); ++c) {
    const std::span<const Span> spans = sink.column(c);
    float solid = 0;
    for (const Span& span : spans) solid += span.top - span.bottom;
    tops.top.push_back(spans.empty() ? grid.edge_y(0) : spans.back().top);
    tops.air.push_back(tops.top.back() - grid.edge_y(0) - solid);
    tops.has_cave.push_back(tops.air.back() > 0.5F * static_cast<float>(grid.step));
  }
  return tops;
}

// Groups of marked columns that touch along a side.
std::size_t count_groups(std::vector<char> marked, int width) {
  std::size_t groups = 0;
  std::vector<int> stack;
  for (std::size_t start = 0; start < marked.size(); ++start) {
    if (!marked[start]) continue;
    ++groups;
    stack.assign(1, static_cast<int>(start));
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      if (!marked[static_cast<std::size_t>(at)]) continue;
      marked[static_cast<std::size_t>(at)] = 0;
      if (at % width > 0) stack.push_back(at - 1);
      if (at % width + 1 < width) stack.push_back(at + 1);
      if (at >= width) stack.push_back(at - width);
      if (static_cast<std::size_t>(at + width) < marked.size()) stack.push_back(at + width);
    }
  }
  return groups;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_terrain(at.terrain, options.seed));
  const std::unique_ptr<LayeredStack> built = stack_at_resolution(source, at.integer("n"), progress);
  const LayeredStack& stack = *built;
  const auto reading = static_cast<ColumnHeight>(at.parameters.choice("reading"));
  const Heightfield map = column_heights(stack, reading);
  const Tops tops = tops_of(stack);
  const float tolerance = 0.5F * static_cast<float>(stack.grid().step);
  std::vector<char> sunk;
  std::size_t caves = 0, sunk_columns = 0, raised = 0, sunk_beside_caves = 0;
  float deepest = 0, error = 0;
  for (std::size_t c = 0; c < tops.top.size(); ++c) {
    const float depth = tops.top[c] - map.heights[c];
    sunk.push_back(depth > tolerance);
    caves += tops.has_cave[c] != 0;
    sunk_columns += sunk.back() != 0;
    raised += depth < -tolerance;
    sunk_beside_caves += sunk.back() != 0 && tops.has_cave[c] == 0;
    deepest = std::max(deepest, depth);
    error = std::max(error, std::abs(depth - (reading == ColumnHeight::kSum ? tops.air[c] : 0.0F)));
  }
  recorder.add("columns_with_caves", "", static_cast<double>(caves));
  recorder.add("sunk_columns", "", static_cast<double>(sunk_columns));
  recorder.add("sunk_columns_without_cave", "", static_cast<double>(sunk_beside_caves));
  recorder.add("raised_columns", "", static_cast<double>(raised));
  recorder.add("dents", "", static_cast<double>(count_groups(sunk, map.width)));
  recorder.add("deepest_dent", "m", deepest);
  recorder.add("largest_error", "m", error);
  recorder.add("largest_step", "m", largest_step(map));
  recorder.add("largest_step_interpolated", "m",
               largest_step(height_map(stack, reading, at.integer("finer"))));
}

}  // namespace

extern const Experiment kSumHeights{"hybrid.sum-heights", "§3.5: the far ground's height map from the stacks",
                                    specs(), cases, measure};

}  // namespace terrabench::hybrid
