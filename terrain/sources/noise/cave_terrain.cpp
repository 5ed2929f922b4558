#include "terrain/sources/noise/cave_terrain.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/sources/noise/program.h"

namespace terrabench::noise {
namespace {

// The paper prints no numbers for these. They are chosen so that hills, overhangs and tunnels are clearly
// visible at 128³, and roughness alone cuts off little. Lengths are shares of the extent, frequencies are
// lattice cells per extent.
struct Shape {
  float frequency, gain, reach;
};
constexpr Shape kHills{2.0F, 0.42F, 0.55F};
constexpr Shape kOverhangs{3.0F, 0.32F, 0.5F};
constexpr Shape kCaves{3.5F, 0.35F, 0.0F};
constexpr Shape kRoughness{5.0F, 0.32F, 0.06F};
// The fractal's provable range is twice the range of its values: the limit removes no hill and lets the
// evaluation prove that the surface lies in the middle of the cube.
constexpr float kHillLimit = 0.55F;
// A ridged multifractal, weakened by the attenuation, allows a cave where it reaches this value.
constexpr float kCaveThreshold = 0.72F;
// Caves have their full width up to the lower height, and none at all well below the upper.
constexpr float kAttenuationLow = 0.15F, kAttenuationHigh = 0.75F, kAttenuationBias = 0.75F;

constexpr std::array<StageInfo, kStages> kStageInfo = {{
    {Stage::kGradient, 3, "gradient", 0, 1},
    {Stage::kClampedGradient, 4, "clamped gradient", 0, 1},
    {Stage::kFbm, 5, "fBm", -0.5F, 0.5F},
    {Stage::kFlatFbm, 6, "fBm sampled along y = 0", -0.5F, 0.5F},
    {Stage::kYPerturbed, 7, "y-perturbed terrain", 0, 1},
    {Stage::kXYPerturbed, 8, "x- and y-perturbed terrain", 0, 1},
    {Stage::kRidged, 9, "ridged multifractal", 0, 1},
    {Stage::kClampedRidged, 10, "clamped ridged multifractal", 0, 1},
    {Stage::kPerturbedRidged, 11, "perturbed ridged multifractal", 0, 1},
    {Stage::kMultiplied, 12, "the cave map of figure 11 times the terrain of figure 8", 0, 1},
    {Stage::kAttenuated, 13, "the product of figure 12 with caves that fade with height", 0, 1},
}};

// The paper's graph, stage by stage, each stage a node that the next builds on.
class Builder {
 public:
  explicit Builder(const CaveOptions& options) : options_(options) {}

  Graph take() { return std::move(graph_); }

  Node gradient() { return graph_.gradient({0, options_.extent, 0}, {0, 0, 0}); }

  Node ground() { return graph_.select(graph_.constant(0), graph_.constant(1), gradient(), 0.5F); }

  Node hill_noise() { return graph_.fbm(fractal(0, kHills)); }

  Node flat_hill_noise() { return graph_.scale_domain(hill_noise(), 1, 0, 1); }

  Node y_perturbed() {
    const Node limited = graph_.clamp(flat_hill_noise(), -kHillLimit, kHillLimit);
    const Node height = graph_.scale_offset(limited, kHills.reach * options_.extent, 0);
    return graph_.translate_domain(ground(), {}, height);
  }

  Node xy_perturbed() { return graph_.translate_domain(y_perturbed(), shift(1, kOverhangs)); }

  // 0 or 1: the two multifractals differ in their seed and with it in the offsets of their octaves.
  Node ridged(std::uint64_t which) { return graph_.ridged_multifractal(fractal(2 + which, kCaves)); }

  // 1 where ridged multifractal `which` is close enough to its crests to allow a cave.
  Node cave(std::uint64_t which, bool attenuated) {
    const Node strength = attenuated ? graph_.multiply(attenuation(), ridged(which)) : ridged(which);
    return graph_.select(graph_.constant(0), graph_.constant(1), strength, kCaveThreshold);
  }

  // The paper's form of the same: 0 in caves.
  Node map(Node cave) { return graph_.scale_offset(cave, -1, 1); }

  Node perturbed(Node cave, std::uint64_t which = 4) {
    return graph_.translate_domain(cave, graph_.cache(shift(which, kRoughness)));
  }

  // In two dimensions one map is enough.
  Node one_cave(bool attenuated) { return perturbed(map(cave(0, attenuated))); }

  // In three, one ridged multifractal would cut the terrain apart.
  Node both_caves(bool attenuated) {
    const Node first = cave(0, attenuated), second = cave(1, attenuated);
    // Its time alone is of interest, so there is no such form of the printed product.
    if (!options_.share_roughness && !options_.printed_product)
      return map(graph_.multiply(perturbed(first), perturbed(second, 5)));
    const Node combined = options_.printed_product ? graph_.multiply(map(first), map(second))
                                                   : map(graph_.multiply(first, second));
    return perturbed(combined);
  }

  // The terrain is the mask, so that no cave is evaluated in the air.
  Node carved(Node terrain, Node cave_map) { return graph_.multiply(terrain, cave_map); }

 private:
  Fractal fractal(std::uint64_t which, const Shape& shape) const {
    // No two terrains share the seed of a fractal.
    return {.seed = options_.seed * 16 + which,
            .frequency = shape.frequency / options_.extent,
            .octaves = 6,
            .gain = shape.gain};
  }

  Node shift(std::uint64_t which, const Shape& shape) {
    return graph_.scale_offset(graph_.fbm(fractal(which, shape)), shape.reach * options_.extent, 0);
  }

  Node attenuation() {
    const float e = options_.extent;
    return graph_.bias(graph_.gradient({0, kAttenuationHigh * e, 0}, {0, kAttenuationLow * e, 0}),
                       kAttenuationBias);
  }

  CaveOptions options_;
  Graph graph_;
};

Node stage_node(Builder& b, Stage stage) {
  switch (stage) {
    case Stage::kGradient:
      return b.gradient();
    case Stage::kClampedGradient:
      return b.ground();
    case Stage::kFbm:
      return b.hill_noise();
    case Stage::kFlatFbm:
      return b.flat_hill_noise();
    case Stage::kYPerturbed:
      return b.y_perturbed();
    case Stage::kXYPerturbed:
      return b.xy_perturbed();
    case Stage::kRidged:
      return b.ridged(0);
    case Stage::kClampedRidged:
      return b.map(b.cave(0, false));
    case Stage::kPerturbedRidged:
      return b.one_cave(false);
    case Stage::kMultiplied:
      return b.carved(b.xy_perturbed(), b.one_cave(false));
    case Stage::kAttenuated:
      return b.carved(b.xy_perturbed(), b.one_cave(true));
  }
  return {};
}

CaveGraph terrain_graph(const CaveOptions& o) {
  Builder b(o);
  Node root = o.perturb_x ? b.xy_perturbed() : b.y_perturbed();
  if (o.caves) root = b.carved(root, b.both_caves(o.attenuation));
  return {b.take(), root};
}

// The graph says 1 for ground and 0 for air.
void fill_column(const Program& program, const ColumnSamples& at, std::span<Material> out) {
  thread_local std::vector<float> values;
  if (values.size() < out.size()) values.resize(out.size());
  program.column(at, std::span(values).first(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = values[i] > 0.5F ? Material::kBedrock : Material::kAir;
}

}  // namespace

const StageInfo& info(Stage stage) { return kStageInfo[static_cast<std::size_t>(stage)]; }

CaveGraph graph_for(Stage stage, const CaveOptions& options) {
  Builder b(options);
  const Node root = stage_node(b, stage);
  return {b.take(), root};
}

Solid cave_terrain(const CaveOptions& options) {
  if (!std::isfinite(options.extent) || options.extent <= 0) {
    throw usage_error(fmt::format("extent must be above 0 m, got {}", options.extent), "cave terrain",
                      "it is the side of the cube");
  }
  const CaveGraph cave = terrain_graph(options);
  Solid solid;
  solid.bounds = {glm::vec3(0), glm::vec3(options.extent)};
  // The graph's text holds every option that shapes the terrain.
  solid.checksum = checksum(
      fmt::format("cave terrain {} root {}\n{}", options.extent, cave.root.index, cave.graph.describe()));
  const Evaluation evaluation = options.every_cell ? Evaluation::kEverySample : Evaluation::kWhereNeeded;
  solid.column = [program = std::make_shared<const Program>(cave.graph, cave.root, evaluation)](
                     const ColumnSamples& at, std::span<Material> out) { fill_column(*program, at, out); };
  return solid;
}

TerrainSource cave_source(const CaveOptions& options) {
  TerrainSource source;
  source.name = "caves";
  source.solid = cave_terrain(options);
  source.checksum = source.solid->checksum;
  return source;
}

}  // namespace terrabench::noise
