// MRBSP with the conforming hole rule: the time to choose the triangles of a frame, along a walk in a circle
// over 257² and 1025² samples. (Experiments time its printed rules, and the conforming one inside whole
// frames.)
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "lod/mrbsp/mrbsp.h"
#include "tests/bench/mountains.h"

namespace terrabench {
namespace {

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

void choose(benchmark::State& state) {
  Heightfield field = mountains(static_cast<int>(state.range(0)));
  field.cell_x = field.cell_z = 30;
  Progress silent;
  MrbspOptions options;
  options.area_consistent = state.range(1) != 0;
  if (state.range(3) == 0) options.holes = HoleRule::kPrinted;
  Mrbsp lod(field, options, silent);
  lod.tune(static_cast<double>(state.range(2)));
  const std::vector<View> views = walk(field);
  double triangles = 0;
  std::size_t frame = 0;
  for (auto _ : state) {
    triangles += static_cast<double>(lod.update(views[frame % views.size()]).stats.triangles);
    ++frame;
  }
  state.counters["triangles"] = triangles / static_cast<double>(frame);
}
BENCHMARK(choose)
    ->ArgNames({"side", "area", "size", "conforming"})
    ->Args({257, 0, 6, 1})
    ->Args({257, 0, 6, 0})
    ->Args({257, 1, 24, 1})
    ->Args({1025, 0, 3, 1})
    ->Args({1025, 1, 20, 1})
    ->Args({1025, 1, 20, 0})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace terrabench
