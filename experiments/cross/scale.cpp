// Every cost against the size of the ground: structures over height maps and over a solid, level-of-detail
// methods along a walk, and flow routing. The ground of height maps grows as a window on endless hills does,
// with the same work per column; the solid is one cube of caves at finer and finer resolution.
//
// Theory. Over heights, what a structure builds, holds, writes and draws is proportional to the columns; a
// query takes the same time at any size. Over a solid of n columns there are n^1.5 voxels, and surfaces have
// area in proportion to n: dense voxels hold the former, all others the latter, and building samples every
// voxel. What follows from each method's own header stands in the tables below.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "experiments/cases.h"
#include "experiments/cross/scale_run.h"
#include "experiments/cross/temporary_folder.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "representations/representation.h"
#include "terrain/files.h"
#include "terrain/hydrology/flow.h"

namespace terrabench::cross {
namespace {

// Exponents of the number of columns.
struct StructureTheory {
  std::string_view name;
  double build, bytes, query, mesh;
};
constexpr double kVoxels = 1.5;  // the number of voxels of a solid
constexpr double kLevels = 0.5;  // the number of levels of its columns
constexpr std::array kOverHeights{
    StructureTheory{"heightmap", 1, 1, 0, 1}, StructureTheory{"layered_stack", 1, 1, 0, 1},
    StructureTheory{"voxel", 1, 1, 0, 1},     StructureTheory{"dense_voxel", 1, 1, 0, 1},
    StructureTheory{"implicit", 1, 1, 0, 1},  StructureTheory{"drill", 1, 1, 0, 1},
    StructureTheory{"ght", 1, 1, 0, 1},       StructureTheory{"procedural_mesh", 1, 1, 0, 1},
};
// Those that hold overhangs. A column of stacks is as long as its runs; voxels are read level by level.
constexpr std::array kOverSolids{
    StructureTheory{"layered_stack", kVoxels, 1, 0, 1},
    StructureTheory{"voxel", kVoxels, 1, kLevels, kVoxels},
    StructureTheory{"dense_voxel", kVoxels, kVoxels, kLevels, kVoxels},
    StructureTheory{"implicit", kVoxels, 1, kLevels, kVoxels},
};

constexpr std::array<std::string_view, 4> kFamilies{"heights", "solids", "lods", "flow"};
constexpr std::string_view kWholeMetres = "whole_metres", kUnrounded = "unrounded";

const std::array kSpecs{
    choice("family", kFamilies, "what is measured: structures over heights or solids, methods, flow routing"),
    ParameterSpec{"method", std::string("heightmap"), "",
                  "a name of `terrabench list`; for flow, whole_metres or unrounded"},
    ParameterSpec{"smallest", std::int64_t{129}, "samples", "side of the smallest ground", 8, 32769},
    ParameterSpec{"largest", std::int64_t{1025}, "samples", "side of the largest ground", 8, 32769},
    ParameterSpec{"seconds", 4.0, "s", "processor time for all sizes; a size that would exceed it is skipped",
                  0, 1e6},
    ParameterSpec{"memory", 20.0, "GiB", "largest heap; a size that would exceed it is skipped", 0.001, 1e6},
    ParameterSpec{"pixels", 2.0, "px", "screen-space error of the methods", 0.05, 200},
};

constexpr int kBatch = 1024, kQueries = 1 << 16, kQueryTurns = 3;  // columns per call, and per sample
constexpr double kQuerySeconds = 0.05;                             // per sample, of slow structures
constexpr int kNear = 32;         // columns on each side of the window of near queries, which caches hold
constexpr float kHighest = 1600;  // metres, of the hills

// Hills from 0 to kHighest metres exactly, so that no size has more levels than another: two corners are the
// lowest and the highest sample.
TerrainSource hills_of_one_range(int side, std::uint64_t seed) {
  TerrainSource source;
  source.name = "noise-hills";
  source.heights = noise_hills(side, seed);
  for (float& h : source.heights->heights) h = std::clamp(h, 0.0F, kHighest);
  source.heights->heights.front() = 0;
  source.heights->heights.back() = kHighest;
  return source;
}

// splitmix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  float unit() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<float>((z ^ (z >> 31)) >> 40) * 0x1p-24F;
  }

 private:
  std::uint64_t state_;
};

// Processor seconds per column at random places in the middle `share` of the bounds' sides. The first batch
// is not counted; no batch repeats the places of another.
double seconds_per_query(const Representation& structure, double share, Random& random) {
  const Bounds bounds = structure.bounds();
  const glm::vec3 middle = 0.5F * (bounds.low + bounds.high), half = 0.5F * bounds.size();
  std::vector<float> x(kBatch), z(kBatch);
  SpanSink sink;
  double spent = 0;
  int asked = -kBatch;
  while (asked < kQueries && spent < kQuerySeconds) {
    for (int i = 0; i < kBatch; ++i) {
      x[i] = middle.x + static_cast<float>(share) * half.x * (2 * random.unit() - 1);
      z[i] = middle.z + static_cast<float>(share) * half.z * (2 * random.unit() - 1);
    }
    sink.clear();
    const double begin = thread_seconds();
    structure.spans({x, z}, sink);
    if (asked >= 0) spent += thread_seconds() - begin;
    asked += kBatch;
  }
  return spent / asked;
}

void measure_structure(const Run& run, bool solid, const StructureTheory& theory) {
  const RepresentationType& type = representation(theory.name);
  SizePlan building = run.plan("build", 0.5, {theory.build, theory.bytes});
  SizePlan saving = run.plan("file", 0.25, {theory.bytes, theory.bytes});
  SizePlan meshing = run.plan("mesh", 0.25, {theory.mesh, std::max(theory.bytes, 1.0)});
  Cost build("build", "s", theory.build), bytes("bytes", "B", theory.bytes), file("file", "B", theory.bytes),
      build_faults("build_faults", "faults", theory.build), mesh_faults("mesh_faults", "faults", theory.mesh),
      query("query", "s", theory.query), near("query_near", "s", theory.query),
      mesh("mesh", "s", theory.mesh);
  const TemporaryFolder folder;
  Random random(run.seed());
  const std::vector<int> sides = run.sides(solid);
  run.progress().begin(fmt::format("{} over {}", type.name, solid ? "a solid" : "heights"), sides.size());
  Progress silent;  // a structure's own phases would end this one
  for (const int side : sides) {
    const double columns = squared(side);
    TerrainSource source;
    std::unique_ptr<Representation> built;
    const auto build_and_ask = [&] {
      source = solid ? open_terrain("caves", run.seed()) : hills_of_one_range(side, run.seed());
      Parameters parameters(type.parameters);
      if (solid) parameters.set("resolution", std::int64_t{side});
      add_turns(
          build, build_faults, columns, turns(std::pow(columns, theory.build)), [&] { built.reset(); },
          [&] { built = type.build(source, parameters, silent); });
      bytes.add(columns, static_cast<double>(built->memory().total()));
      for (int turn = 0; turn < kQueryTurns; ++turn) {
        query.add(columns, seconds_per_query(*built, 1, random));
        near.add(columns,
                 seconds_per_query(*built, std::min(1.0, static_cast<double>(kNear) / side), random));
      }
    };
    const bool exists = run.measured(building, columns, build_and_ask);
    run.progress().advance();
    if (!exists) continue;
    source = {};
    run.measured(saving, columns, [&] {
      file.add(columns, static_cast<double>(save_representation(folder.path() / "saved", type, *built)));
    });
    run.measured(meshing, columns, [&] {
      TriangleMesh drawn;
      add_turns(
          mesh, mesh_faults, columns, turns(std::pow(columns, theory.mesh)), [&] { drawn = {}; },
          [&] { drawn = built->mesh({}); });
    });
  }
  run.progress().end();
  for (const SizePlan* const plan : {&building, &saving, &meshing}) plan->record(run.recorder());
  for (const Cost* const cost : {&build, &build_faults, &bytes, &file, &query, &near, &mesh, &mesh_faults})
    cost->record(run.recorder());
}

// Whole metres are sorted into buckets, in O(n); heights as they are need a heap, in O(n log n).
void measure_flow(const Run& run, bool whole) {
  SizePlan plan = run.plan("route", 1, {1, 1});
  Cost route("route", "s", 1, !whole), route_faults("route_faults", "faults", 1);
  const std::vector<int> sides = run.sides(false);
  run.progress().begin(whole ? "flow over whole metres" : "flow over unrounded heights", sides.size());
  for (const int side : sides) {
    const double columns = squared(side);
    run.measured(plan, columns, [&] {
      Heightfield ground = noise_hills(side, run.seed());
      if (whole) ground = whole_metres(std::move(ground));
      FlowNetwork network;
      add_turns(
          route, route_faults, columns, turns(columns), [&] { network = {}; },
          [&] { network = route_flow(ground); });
    });
    run.progress().advance();
  }
  run.progress().end();
  plan.record(run.recorder());
  route.record(run.recorder());
  route_faults.record(run.recorder());
}

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  // Solids take 40 s in the paper profile, which reaches 512³.
  std::vector<Case> cases;
  const auto add = [&](std::string_view family, std::string_view method, std::int64_t smallest,
                       std::int64_t largest) {
    cases.push_back({fmt::format("{}/{}", family, method),
                     {kSpecs,
                      {{"family", std::string(family)},
                       {"method", std::string(method)},
                       {"smallest", smallest},
                       {"largest", largest},
                       {"seconds", !paper               ? 8.0
                                   : family == "solids" ? 40.0
                                                        : 25.0}}}});
  };
  for (const StructureTheory& one : kOverHeights) {
    const bool voxels = one.name.ends_with("voxel");  // take seconds from 1025² columns on
    add("heights", one.name, 129, paper ? 16385 : voxels ? 513 : 1025);
  }
  for (const StructureTheory& one : kOverSolids) add("solids", one.name, 32, paper ? 1024 : 128);
  for (const std::string_view one : scaled_lods()) add("lods", one, 513, paper ? 8193 : 2049);
  for (const std::string_view one : {kWholeMetres, kUnrounded}) add("flow", one, 129, paper ? 16385 : 1025);
  return cases;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Run run(at, options, recorder, progress);
  const std::string &family = at.parameters.text("family"), &method = at.parameters.text("method");
  if (family == "solids") {
    recorder.terrain(open_terrain("caves", options.seed));
    measure_structure(run, true, entry(kOverSolids, "structure for solids", method));
    return;
  }
  recorder.terrain("noise-hills", checksum(fmt::format("noise-hills {}", options.seed)));
  if (family == "heights") measure_structure(run, false, entry(kOverHeights, "structure", method));
  if (family == "lods") measure_lod(run, method);
  if (family == "flow") {
    constexpr std::array<std::string_view, 2> kKnown{kWholeMetres, kUnrounded};
    if (std::ranges::count(kKnown, method) == 0) throw unknown_name("kind of heights", method, kKnown);
    measure_flow(run, method == kWholeMetres);
  }
}

}  // namespace

extern const Experiment kScale{"cross.scale", "Every cost against the size of the ground", kSpecs, cases,
                               measure};

}  // namespace terrabench::cross
