// The Grounded Heightmap Tree: events by the size of the terrain and of the region they touch, the rain of
// particles and the sequence of the paper's §4.2, and one edit beside layered stacks and OpenVDB (`voxel`).
// All on one thread. `cells` is the number of cells that an event adds, a measure of its region.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "representations/ght/ght.h"
#include "representations/ght/invariants.h"
#include "terrain/error.h"

namespace {

using namespace terrabench;

// Processor time of this thread, in seconds.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Samples 1 m apart: hills 60 m wide and some 10 m high, roughened.
Heightfield rolling(int n) {
  Heightfield field{n, n, 1, 1, {}, {}};
  field.heights.reserve(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  std::minstd_rand random(1);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      field.heights.push_back(
          40 + 5 * std::sin(0.1F * static_cast<float>(i)) * std::cos(0.09F * static_cast<float>(j)) +
          0.2F * static_cast<float>(random() % 256) / 256);
    }
  }
  return field;
}

// On the heap, because memory() counts the object itself.
std::unique_ptr<Ght> make_tree(const Heightfield& field) {
  return std::make_unique<Ght>(ght::SampleGrid{field.width, field.depth, field.cell_x, field.cell_z, 0, 0},
                               field.heights, 0.0F);
}

// An event of each kind in the middle of a terrain of `size` metres, `reach` metres to each side.
struct NamedEvent {
  std::string_view name;
  events::Event event;
};
std::vector<NamedEvent> events_of(const Heightfield& field, double reach) {
  const double middle = field.extent_x() / 2;
  const auto at = [&](double x, double z) { return glm::dvec2(middle + x * reach, middle + z * reach); };
  const double ground = field.sample(static_cast<float>(middle), static_cast<float>(middle));
  const double low = std::fmin(reach / 4, 4);  // metres by which the ground moves up or down
  return {{"linear erosion", events::LinearErosion{at(-0.4, -0.3), at(0.4, 0.3), reach / 2, 45}},
          {"radial erosion", events::RadialErosion{{middle, ground, middle}, {reach, low, reach}}},
          {"normal fault", events::DipFault{false, at(-0.6, -0.5), at(0.6, 0.5), 0.6 * reach, low, 60}},
          {"inverse fault", events::DipFault{true, at(-0.6, -0.5), at(0.6, 0.5), 0.6 * reach, low, 60}},
          {"lateral fault", events::LateralFault{at(-0.6, -0.5), at(0.6, 0.5), 0.6 * reach, reach / 4}}};
}
constexpr int kOutdoorKinds = 5;

// Times the event only; the tree is built again outside the measured time.
void time_event(benchmark::State& state, int n, double reach) {
  const Heightfield field = rolling(n);
  const NamedEvent one = events_of(field, reach)[static_cast<std::size_t>(state.range(0))];
  std::size_t cells = 0;
  for (auto _ : state) {
    const auto tree = make_tree(field);
    const std::size_t before = tree->model().tree.cells();
    const double start = thread_seconds();
    tree->apply(one.event);
    state.SetIterationTime(thread_seconds() - start);
    cells = tree->model().tree.cells() - before;
  }
  state.counters["cells"] = static_cast<double>(cells);
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(cells * state.iterations()), benchmark::Counter::kIsRate);
  state.SetLabel(std::string(one.name));
}

void event_by_terrain(benchmark::State& state) { time_event(state, static_cast<int>(state.range(1)), 24); }
void event_by_region(benchmark::State& state) {
  time_event(state, 1024, static_cast<double>(state.range(1)));
}

// Particles that each crash into the current ground.
class Rain {
 public:
  Rain(const Heightfield& field, unsigned seed) : extent_(field.extent_x()), random_(seed) {}
  events::RadialErosion next(const Ght& tree) {
    const double radius = number(1.5, 4);
    const double x = number(10, extent_ - 10), z = number(10, extent_ - 10);
    return {{x, tree.model().surface.top(tree.model().tree, {x, z}), z}, {radius, 0.3 * radius, radius}};
  }

 private:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double extent_;
  std::mt19937 random_;
};

void rain(benchmark::State& state) {
  const Heightfield field = rolling(static_cast<int>(state.range(0)));
  const auto particles = state.range(1);
  double bytes = 0, per_cell = 0;
  for (auto _ : state) {
    const auto tree = make_tree(field);
    const double start = thread_seconds();
    Rain rain(field, 1);
    for (std::int64_t p = 0; p < particles; ++p) tree->apply(rain.next(*tree));
    state.SetIterationTime(thread_seconds() - start);
    bytes = static_cast<double>(tree->memory().total());
    per_cell = bytes / static_cast<double>(tree->model().tree.cells());
  }
  state.SetItemsProcessed(state.iterations() * particles);
  state.counters["bytes/cell"] = per_cell;
  state.counters["bytes/sample"] = bytes / static_cast<double>(field.heights.size());
}

// The overlapping sequence of §4.2: every geotectonic kind of event, and then a rain.
std::unique_ptr<Ght> sequence(int n, int particles) {
  const Heightfield field = rolling(n);
  auto tree = make_tree(field);
  const double size = field.extent_x(), reach = 0.2 * size;
  const auto at = [&](double x, double z) { return glm::dvec2(x * size, z * size); };
  const std::vector<events::Event> all = {
      events::LinearErosion{at(0.2, 0.3), at(0.55, 0.4), 0.05 * size, 35},
      events::DipFault{false, at(0.3, 0.25), at(0.5, 0.6), 0.15 * size, 0.05 * size, 60},
      events::LateralFault{at(0.35, 0.6), at(0.75, 0.4), 0.1 * size, 0.05 * size},
      events::DipFault{true, at(0.6, 0.75), at(0.85, 0.7), 0.12 * size, 0.06 * size, 50},
      events::RadialErosion{{0.45 * size, 40, 0.45 * size}, {0.6 * reach, 0.1 * reach + 4, 0.5 * reach}},
      events::RadialErosion{{0.52 * size, 40, 0.38 * size}, {0.3 * reach, 6, 0.4 * reach}},
      events::LinearErosion{at(0.2, 0.7), at(0.4, 0.8), 0.04 * size, 30}};
  for (const events::Event& event : all) tree->apply(event);
  Rain rain(field, 2);
  for (int p = 0; p < particles; ++p) {
    try {
      tree->apply(rain.next(*tree));
    } catch (const Error&) {  // over the overhang
    }
  }
  return tree;
}

constexpr std::size_t kBatch = 1 << 14;

void columns_after_sequence(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto tree = sequence(n, static_cast<int>(state.range(1)));
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, static_cast<float>(n - 1));
  std::vector<float> x(kBatch), z(kBatch);
  for (std::size_t i = 0; i < kBatch; ++i) x[i] = unit(random), z[i] = unit(random);
  SpanSink sink;
  for (auto _ : state) {
    sink.clear();
    tree->spans({x, z}, sink);
    benchmark::DoNotOptimize(sink.all().data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kBatch));
  const ght::Census census = ght::census(tree->model());
  state.counters["nodes"] = static_cast<double>(census.nodes);
  state.counters["faces"] = static_cast<double>(census.faces);
  const std::size_t cells = tree->model().tree.cells();
  state.counters["bytes/cell"] = static_cast<double>(tree->memory().total()) / static_cast<double>(cells);
  state.counters["payload/cell"] = static_cast<double>(tree->memory().payload) / static_cast<double>(cells);
}

// One radial erosion of each structure: an event for the tree, for the others an edit of air column by
// column, with one column per sample.
void same_edit(benchmark::State& state) {
  constexpr std::array<std::string_view, 3> kNames = {"ght", "layered_stack", "voxel"};
  const std::string_view name = kNames[static_cast<std::size_t>(state.range(0))];
  TerrainSource source;
  source.name = "rolling";
  source.heights = rolling(static_cast<int>(state.range(1)));
  const auto erosion = std::get<events::RadialErosion>(events_of(*source.heights, 16)[1].event);
  const RepresentationType& type = representation(name);
  Parameters parameters(type.parameters);
  Progress progress;
  std::vector<float> x, z;
  std::vector<Span> air;
  for (int j = 0; j < source.heights->depth; ++j) {
    for (int i = 0; i < source.heights->width; ++i) {
      const double bottom = erosion.bottom({i, j});
      if (bottom == HUGE_VAL) continue;
      x.push_back(static_cast<float>(i)), z.push_back(static_cast<float>(j));
      air.push_back({static_cast<float>(bottom), 1e4F, Material::kAir});
    }
  }
  double before = 0, after = 0;
  for (auto _ : state) {
    const auto structure = type.build(source, parameters, progress);
    before = static_cast<double>(structure->memory().total());
    const double start = thread_seconds();
    if (auto* const tree = dynamic_cast<Ght*>(structure.get())) {
      tree->apply(erosion);
    } else {
      structure->edit({x, z}, air);
    }
    state.SetIterationTime(thread_seconds() - start);
    after = static_cast<double>(structure->memory().total());
  }
  state.counters["columns"] = static_cast<double>(x.size());
  state.counters["bytes"] = after;
  state.counters["bytes added"] = after - before;
  state.SetLabel(std::string(name));
}

BENCHMARK(event_by_terrain)
    ->ArgsProduct({benchmark::CreateDenseRange(0, kOutdoorKinds - 1, 1), {128, 512, 2048, 4096}})
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(event_by_region)
    ->ArgsProduct({benchmark::CreateDenseRange(0, kOutdoorKinds - 1, 1), {8, 16, 32, 64, 128, 256}})
    ->UseManualTime()
    ->Iterations(10)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(rain)->Args({1024, 10'000})->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(columns_after_sequence)->ArgsProduct({{129, 513}, {0, 500}});
BENCHMARK(same_edit)
    ->ArgsProduct({{0, 1, 2}, {128, 512, 1024}})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
