// MRBSP: time to build a tree of 65,536 and of 16 million triangles, to choose the triangles of a frame (the
// paper: 1/320 s) and to compute visibility, with the bytes and the misses of the visible sets.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "lod/mrbsp/mrbsp.h"
#include "lod/mrbsp/nearest_three.h"
#include "lod/mrbsp/visibility/codec.h"
#include "lod/mrbsp/visibility/line_of_sight.h"
#include "terrain/source.h"

namespace {

using namespace terrabench;
namespace visibility = mrbsp::visibility;

Progress& silent() {
  static Progress progress;
  return progress;
}

// The packaged mountain terrain resampled to side × side samples.
Heightfield mountains(int side) { return resample(*open_terrain("jacksboro").heights, side, side); }

// A circular walk: 200 eyes at 1.8 m, looking ahead. The field of view is 40° wide, as the paper's share of
// triangles in view suggests.
std::vector<View> walk(const Heightfield& field) {
  std::vector<View> views;
  for (int k = 0; k < 200; ++k) {
    const float angle = 6.2831853F * static_cast<float>(k) / 200;
    const glm::vec2 way(std::cos(angle), std::sin(angle));
    View view;
    view.eye.x = field.extent_x() * (0.5F + 0.25F * way.x);
    view.eye.z = field.extent_z() * (0.5F + 0.25F * way.y);
    view.eye.y = field.sample(view.eye.x, view.eye.z) + 1.8F;
    view.target = view.eye + glm::vec3(-way.y, 0, way.x);
    view.vertical_fov = 0.53F;
    view.far = 2 * (field.extent_x() + field.extent_z());
    views.push_back(view);
  }
  return views;
}

void build_tree(benchmark::State& state) {
  const int depth = static_cast<int>(state.range(0));
  MrbspOptions options;
  options.depth = depth;
  options.three_nearest = state.range(1) != 0;
  const Heightfield field = mountains((1 << (depth / 2)) + 1);
  Memory memory;
  for (auto _ : state) {
    const auto lod = std::make_unique<Mrbsp>(field, options, silent());  // memory() asks for its own block
    memory = lod->memory();
  }
  state.counters["triangles"] = std::pow(2.0, depth);
  state.counters["bytes/triangle"] = static_cast<double>(memory.total()) / std::pow(2.0, depth);
}
BENCHMARK(build_tree)
    ->ArgNames({"depth", "nearest"})
    ->Args({16, 0})
    ->Args({16, 1})
    ->Args({24, 0})
    ->Args({24, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void choose_triangles(benchmark::State& state) {
  const int depth = static_cast<int>(state.range(0));
  const Heightfield field = mountains((1 << (depth / 2)) + 1);
  MrbspOptions options;
  options.depth = depth;
  options.area_consistent = state.range(1) != 0;
  options.holes = state.range(2) != 0 ? HoleRule::kConforming : HoleRule::kPrinted;
  Mrbsp lod(field, options, silent());
  lod.tune(static_cast<double>(state.range(3)));
  const std::vector<View> views = walk(field);
  double triangles = 0;
  std::size_t frame = 0;
  for (auto _ : state) {
    triangles += static_cast<double>(lod.update(views[frame % views.size()]).stats.triangles);
    ++frame;
  }
  state.counters["triangles"] = triangles / static_cast<double>(frame);
}
BENCHMARK(choose_triangles)
    ->ArgNames({"depth", "area", "conforming", "size"})
    ->ArgsProduct({{16}, {0, 1}, {0, 1}, {1, 4, 16}})
    ->Args({16, 0, 1, 64})
    ->Args({16, 1, 1, 64})
    ->Args({16, 1, 1, 65536})
    ->Args({25, 1, 1, 16})
    ->Args({25, 1, 1, 64})
    ->Unit(benchmark::kMicrosecond);

// Counts the fine triangles whose centre an eye sees over the full surface, and those of them that the set of
// the eye's cell lacks.
void count_misses(const Heightfield& field, const BisectionTree& tree, const visibility::Sets& sets,
                  benchmark::State& state) {
  const visibility::CoarseSquares squares(tree, tree.depth());
  const GroundGrid grid = grid_of(field);
  const visibility::LineOfSight lines(grid, squares);
  std::size_t seen = 0, missed = 0;
  std::uint32_t key = 1;
  const auto random = [&] {
    key = key * 1664525U + 1013904223U;
    return static_cast<float>(key >> 8) / 16777216.0F;
  };
  constexpr int kEyes = 20;
  for (int e = 0; e < kEyes; ++e) {
    glm::vec3 eye(random() * static_cast<float>(grid.width - 1), 0,
                  random() * static_cast<float>(grid.depth - 1));
    eye.y = lines.height(eye.x, eye.z) + sets.eye_height;
    const glm::ivec2 cell = sets.cells.cell_at(eye.x, eye.z);
    for (int z = 0; z < squares.along(); ++z) {
      for (int x = 0; x < squares.along(); ++x) {
        for (int half = 0; half < 2; ++half) {
          const std::uint32_t fine = squares.element({x, z}, half);
          const PlanTriangle t = tree.triangle(tree.triangles() + fine);
          const glm::vec2 middle = glm::vec2(t.apex + t.left + t.right) / 3.0F;
          const glm::vec3 target(middle.x, lines.height(middle.x, middle.y), middle.y);
          if (!lines.clear(eye, target)) continue;
          ++seen;
          missed += !sets.sees(cell.y * sets.cells.columns + cell.x, fine >> (tree.depth() - sets.depth));
        }
      }
    }
  }
  state.counters["seen"] = static_cast<double>(seen) / kEyes;
  state.counters["missed_%"] = 100.0 * static_cast<double>(missed) / static_cast<double>(seen);
}

void find_visibility(benchmark::State& state) {
  const int side = static_cast<int>(state.range(0));
  const Heightfield field = mountains(side);
  const BisectionTree tree = BisectionTree::over(side, side);
  visibility::Options options;
  options.mode = state.range(1) != 0 ? visibility::Mode::kConservative : visibility::Mode::kSampled;
  options.cells = static_cast<int>(state.range(2));
  options.coarseness = static_cast<int>(state.range(3));
  visibility::Sets sets;
  for (auto _ : state) sets = find_sets(grid_of(field), tree, options, silent());
  const visibility::EncodedSizes bytes = encoded_sizes(changes_of(sets));
  double share = 0;
  for (int cell = 0; cell < sets.cells.count(); ++cell) share += static_cast<double>(sets.count(cell));
  state.counters["visible_%"] = 100 * share / sets.cells.count() / std::pow(2.0, sets.depth);
  state.counters["bytes"] = static_cast<double>(bytes.changes);
  state.counters["of_lists"] = static_cast<double>(bytes.changes) / static_cast<double>(bytes.lists);
  state.counters["of_bits"] = static_cast<double>(bytes.changes) / static_cast<double>(bytes.bits);
  if (side <= 257) count_misses(field, tree, sets, state);
}
BENCHMARK(find_visibility)
    ->ArgNames({"side", "conservative", "cells", "coarseness"})
    ->ArgsProduct({{257}, {0, 1}, {16, 32}, {4, 6, 8}})
    ->Args({257, 0, 128, 6})
    ->Args({257, 1, 128, 6})
    ->Args({1025, 1, 16, 6})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace
