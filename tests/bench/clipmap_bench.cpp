// Clipmaps over 4097² synthetic mountains, 30 m between samples, in memory (from = 0) and from tiles on disk
// (1), and over endless noise (2). The cost of an update should be proportional to the samples that entered
// the windows. `bytes`: uploads per frame; `of_refill`: their share of the uploads that fill all windows.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

#include "lod/clipmap/clipmap.h"
#include "lod/clipmap/height_source.h"
#include "terrain/sources/dem/dem.h"
#include "tests/bench/mountains.h"

namespace {

using namespace terrabench;

constexpr float kCell = 30;

const Heightfield& ground() {
  static const Heightfield field = [] {
    Heightfield mountain = mountains(4097);
    mountain.cell_x = mountain.cell_z = kCell;
    return mountain;
  }();
  return field;
}

// The ground as a pyramid of tiles, removed at the end of the program.
const std::filesystem::path& tiles() {
  static const struct Folder {
    Folder() {
      std::filesystem::create_directories(path);
      write_geotiff(path / "ground.tif", ground());
      Progress silent;
      HeightPyramid::build((path / "ground.tif").string(), path / "tiles", silent);
      tiles = path / "tiles";
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("clipmap_bench_" + std::to_string(getpid()));
    std::filesystem::path tiles;
  } folder;
  return folder.tiles;
}

std::unique_ptr<HeightSource> source(std::int64_t from) {
  return from == 0   ? heights_in_memory(ground())
         : from == 1 ? heights_on_disk(HeightPyramid::open(tiles()))
                     : endless_heights({.cell = kCell});
}

// Low enough for the finest level, over sample (i, j), looking north.
View over(double i, double j, HeightSource& heights) {
  View view;
  const auto x = static_cast<float>(i * kCell), z = static_cast<float>(j * kCell);
  float height = 0;
  heights.read(0, static_cast<int>(i), static_cast<int>(j), 1, 1, &height, 1);
  view.eye = {x, height + 1.8F, z};
  view.target = view.eye + glm::vec3(0, 0, -1);
  view.far = 200000;
  return view;
}

// Moves by (di, dj) samples per frame and turns back before the border.
void go(benchmark::State& state, double di, double dj, int window, std::int64_t from) {
  const auto heights = source(from == 2 ? 2 : 0);  // for the height of the eye over the same ground
  Clipmap clipmap(source(from), window);
  const double full = static_cast<double>(clipmap.update(over(1000, 1000, *heights)).stats.bytes_uploaded);
  double i = 1000, j = 1000, bytes = 0, moved = 0;
  for (auto _ : state) {
    if (i + di > 3000 || i + di < 900) di = -di;
    if (j + dj > 3000 || j + dj < 900) dj = -dj;
    i += di;
    j += dj;
    const FrameStats& stats = clipmap.update(over(i, j, *heights)).stats;
    bytes += static_cast<double>(stats.bytes_uploaded);
    moved += static_cast<double>(stats.changes);
  }
  const auto average = benchmark::Counter::kAvgIterations;
  state.counters["bytes"] = benchmark::Counter(bytes, average);
  state.counters["levels_moved"] = benchmark::Counter(moved, average);
  state.counters["of_refill"] = benchmark::Counter(bytes / full, average);
}

// 6 km/h at 60 frames per second: most frames move no window.
void walking(benchmark::State& state) {
  go(state, 0.028 / kCell, 0, static_cast<int>(state.range(0)), state.range(1));
}
void one_sample(benchmark::State& state) {
  go(state, 1, 0, static_cast<int>(state.range(0)), state.range(1));
}
// Along both axes: the whole L of the finest level in each frame, and of each coarser level half as often.
void diagonal(benchmark::State& state) { go(state, 2, 2, static_cast<int>(state.range(0)), state.range(1)); }
// Jumps so far that the finest levels keep no sample.
void refill(benchmark::State& state) {
  const auto heights = source(state.range(1) == 2 ? 2 : 0);
  double bytes = 0;
  int frame = 0;
  for (auto _ : state) {
    state.PauseTiming();
    Clipmap clipmap(source(state.range(1)), static_cast<int>(state.range(0)));
    state.ResumeTiming();
    const int at = 1000 + 300 * (++frame % 7);
    bytes += static_cast<double>(clipmap.update(over(at, at, *heights)).stats.bytes_uploaded);
  }
  state.counters["bytes"] = benchmark::Counter(bytes, benchmark::Counter::kAvgIterations);
}

#define CLIPMAP_BENCHMARK(name)                   \
  BENCHMARK(name)                                 \
      ->ArgNames({"n", "from"})                   \
      ->ArgsProduct({{127, 255, 511}, {0, 1, 2}}) \
      ->Unit(benchmark::kMicrosecond)
CLIPMAP_BENCHMARK(walking);
CLIPMAP_BENCHMARK(one_sample);
CLIPMAP_BENCHMARK(diagonal);
CLIPMAP_BENCHMARK(refill);

}  // namespace
