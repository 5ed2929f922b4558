// §3.1 of "hybrid": stacks allow inexpensive queries. Points and columns per second of one thread, beside
// OpenVDB's tree and dense voxels of the same cells.
//
// Two sets of queries: random positions, and coherent ones, along straight lines at steps of a third of a
// cell, as a walker or a ray makes them. The structures take turns round by round, with the same queries, so
// that a busy machine slows all of them; the ratios are those of one round.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "experiments/build_at.h"
#include "experiments/experiment.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "terrain/sources/noise/cave_terrain.h"

namespace terrabench::hybrid {
namespace {

constexpr std::array kSpecs{
    ParameterSpec{"n", std::int64_t{128}, "cells", "cells along each side of the cube", 2, 1024},
    ParameterSpec{"coherent", false, "", "queries along straight lines instead of random positions"},
};

constexpr std::size_t kQueries = 1 << 19, kLine = 256;  // a line has this many queries
constexpr std::array<const char*, 3> kStructures = {"layered_stack", "voxel", "dense_voxel"};
constexpr std::array<const char*, 3> kNames = {"stack", "openvdb", "dense"};

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::int64_t n : {128, 256, 512}) {
    if (n == 512 && options.profile != Profile::kPaper) continue;
    for (const bool coherent : {false, true}) {
      cases.push_back({fmt::format("n={}/{}", n, coherent ? "coherent" : "random"),
                       {kSpecs, {{"n", n}, {"coherent", coherent}}}});
    }
  }
  return cases;
}

struct Positions {
  std::vector<float> x, y, z;
};

float mirrored(float at, float low, float high) {
  const float period = 2 * (high - low);
  const float t = std::fmod(std::abs(at - low), period);
  return low + std::min(t, period - t);
}

// `step` metres between the queries of a line.
Positions positions(const Bounds& box, bool coherent, float step, std::uint64_t seed) {
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  std::uniform_real_distribution<float> share(0, 1);
  const auto anywhere = [&] {
    return box.low + box.size() * glm::vec3(share(random), share(random), share(random));
  };
  Positions all;
  glm::vec3 at{}, along{};
  for (std::size_t k = 0; k < kQueries; ++k) {
    if (!coherent || k % kLine == 0) {
      at = anywhere();
      const float turn = 2 * std::numbers::pi_v<float> * share(random), rise = 2 * share(random) - 1;
      const float level = std::sqrt(1 - rise * rise);
      along = step * glm::vec3(level * std::cos(turn), rise, level * std::sin(turn));
    }
    all.x.push_back(mirrored(at.x, box.low.x, box.high.x));
    all.y.push_back(mirrored(at.y, box.low.y, box.high.y));
    all.z.push_back(mirrored(at.z, box.low.z, box.high.z));
    at += along;
  }
  return all;
}

// Seconds of one round for each structure.
struct Round {
  std::array<double, 3> points, columns;
};

void record(const Round& round, Recorder& recorder) {
  for (std::size_t s = 0; s < kStructures.size(); ++s) {
    recorder.add(fmt::format("points_{}", kNames[s]), "1/s", kQueries / round.points[s]);
    recorder.add(fmt::format("columns_{}", kNames[s]), "1/s", kQueries / round.columns[s]);
    if (s == 0) continue;
    recorder.add_varying(fmt::format("points_to_{}", kNames[s]), "", round.points[s] / round.points[0]);
    recorder.add_varying(fmt::format("columns_to_{}", kNames[s]), "", round.columns[s] / round.columns[0]);
  }
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const std::int64_t n = at.parameters.integer("n");
  const TerrainSource source = recorder.terrain(noise::cave_source({.seed = options.seed}));
  const Bounds box = source.bounds();
  const Positions queries =
      positions(box, at.parameters.flag("coherent"), box.size().x / static_cast<float>(3 * n), options.seed);
  std::array<std::unique_ptr<Representation>, 3> built;
  for (std::size_t s = 0; s < built.size(); ++s) {
    built[s] = build_at_resolution(kStructures[s], source, n, progress);
  }

  std::array<std::vector<Material>, 3> materials;
  std::array<SpanSink, 3> spans;
  for (std::vector<Material>& all : materials) all.resize(kQueries);
  for (int r = -1; r < kSamples; ++r) {  // the first warms the caches and the sinks, and is not recorded
    Round round{};
    for (std::size_t k = 0; k < built.size(); ++k) {
      const std::size_t s = (k + static_cast<std::size_t>(r + 1)) % built.size();  // each goes first in turn
      round.points[s] = processor_seconds([&] {
        built[s]->materials({queries.x, queries.y, queries.z}, materials[s]);
      });
      spans[s].clear();
      round.columns[s] = processor_seconds([&] { built[s]->spans({queries.x, queries.z}, spans[s]); });
    }
    if (r >= 0) record(round, recorder);
  }
  std::size_t solid = 0, differing = 0;
  for (std::size_t k = 0; k < kQueries; ++k) {
    const auto full = [&](std::size_t s) { return materials[s][k] != Material::kAir; };
    solid += full(0);
    differing += full(0) != full(1) || full(0) != full(2);
  }
  recorder.add("queries", "", kQueries);
  recorder.add("solid_share", "", static_cast<double>(solid) / kQueries);
  recorder.add("differing_share", "", static_cast<double>(differing) / kQueries);
}

}  // namespace

extern const Experiment kQueryRates{"hybrid.queries", "§3.1: queries of stacks, OpenVDB and dense voxels",
                                    kSpecs,           cases,
                                    measure,          Experiment::kTimed};

}  // namespace terrabench::hybrid
