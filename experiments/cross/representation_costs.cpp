#include "experiments/cross/representation_costs.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/cross/temporary_folder.h"
#include "experiments/stopwatch.h"

namespace terrabench::cross {
namespace {

// With three samples in each of two runs, the intervals of one in ten unchanged medians exclude each other.
constexpr int kSamples = 9, kFewSamples = 3;
constexpr double kLong = 1;  // seconds: what takes longer is measured once

// Numbers in a range, the same on every machine.
class Numbers {
 public:
  float between(float low, float high) {
    return low + (high - low) * 0x1p-24F * static_cast<float>(random_() >> 8);
  }
  std::vector<float> many(std::size_t n, float low, float high) {
    std::vector<float> all(n);
    for (float& x : all) x = between(low, high);
    return all;
  }

 private:
  std::mt19937 random_{1};
};

// Adds what `work` takes to the metric, kSamples times; kFewSamples times where that takes kLong in all.
template <class Work>
void add_times(Recorder& recorder, std::string_view metric, const Work& work) {
  double all = 0;
  for (int k = 0; k < (all < kLong ? kSamples : kFewSamples); ++k) {
    const double time = seconds(work);
    all += time;
    recorder.add(metric, "s", time);
    if (time > kLong) return;
  }
}

// Calls `batch(k)` until kEnough seconds of processor time are used; queries per second.
template <class Batch>
double rate(std::size_t queries, std::size_t batches, const Batch& batch) {
  constexpr double kEnough = 0.04;
  double time = 0;
  std::size_t done = 0;
  while (done < batches && (done == 0 || time < kEnough)) {
    time += processor_seconds([&] { batch(done); });
    ++done;
  }
  return static_cast<double>(done * queries) / time;
}

}  // namespace

std::unique_ptr<Representation> measure_build(const Scene& scene, const RepresentationType& type,
                                              const Parameters& parameters, Recorder& recorder,
                                              Progress& progress) {
  const auto build = [&] { return type.build(scene.source, parameters, progress); };
  std::unique_ptr<Representation> built = build();  // makes thread pools and tables
  add_times(recorder, "build_time", [&] {
    built.reset();
    built = build();
  });
  const Memory memory = built->memory();
  recorder.add("payload", "B", memory.payload);
  recorder.add("index", "B", memory.index);
  recorder.add("slack", "B", memory.slack);
  recorder.add("bytes", "B", memory.total());
  recorder.add("heap_bytes", "B", static_cast<double>(destroy_and_count(std::move(built))));
  return build();
}

void measure_file(const Scene& scene, const RepresentationType& type, const Representation& built,
                  Recorder& recorder) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scratch";
  std::size_t bytes = 0;
  add_times(recorder, "save_time", [&] { bytes = save_representation(file, type, built); });
  recorder.add("file_bytes", "B", bytes);
  recorder.add("file_of_heightmap", "",
               static_cast<double>(bytes) / static_cast<double>(scene.heightmap_bytes));
  std::unique_ptr<Representation> copy;
  add_times(recorder, "load_time", [&] { copy = load_representation(file).representation; });
  constexpr std::size_t kMost = 4096;
  const std::size_t n = std::min(kMost, scene.lines.x.size());
  const Columns at{std::span(scene.lines.x).first(n), std::span(scene.lines.z).first(n)};
  SpanSink own, loaded;
  built.spans(at, own);
  copy->spans(at, loaded);
  std::size_t differ = 0;
  for (std::size_t c = 0; c < n; ++c) differ += !std::ranges::equal(own.column(c), loaded.column(c));
  recorder.add("loaded_differs", "", differ);
}

void measure_queries(const Scene& scene, const Representation& built, Recorder& recorder) {
  constexpr std::size_t kBatch = 1024, kBatches = 256;
  Numbers numbers;
  const Bounds& bounds = scene.lines.bounds;
  const std::vector<float> x = numbers.many(kBatch * kBatches, bounds.low.x, bounds.high.x),
                           y = numbers.many(kBatch * kBatches, bounds.low.y, bounds.high.y),
                           z = numbers.many(kBatch * kBatches, bounds.low.z, bounds.high.z);
  const auto part = [](const std::vector<float>& all, std::size_t batch) {
    return std::span(all).subspan(batch * kBatch, kBatch);
  };
  std::vector<Material> materials(kBatch);
  SpanSink sink;
  built.spans({part(x, 0), part(z, 0)}, sink);  // warms up
  for (int k = 0; k < kSamples; ++k) {
    recorder.add("points_per_second", "1/s", rate(kBatch, kBatches, [&](std::size_t b) {
                   built.materials({part(x, b), part(y, b), part(z, b)}, materials);
                 }));
    recorder.add("columns_per_second", "1/s", rate(kBatch, kBatches, [&](std::size_t b) {
                   sink.clear();
                   built.spans({part(x, b), part(z, b)}, sink);
                 }));
  }
}

TriangleMesh measure_mesh(const Representation& built, Recorder& recorder) {
  TriangleMesh mesh;
  add_times(recorder, "mesh_time", [&] {
    mesh = {};
    mesh = built.mesh({});
  });
  recorder.add("triangles", "", mesh.triangles());
  return mesh;
}

}  // namespace terrabench::cross
