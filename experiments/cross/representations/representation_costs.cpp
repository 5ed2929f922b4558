#include "experiments/cross/representations/representation_costs.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/stopwatch.h"

namespace terrabench::cross {
namespace {

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

// Calls `batch(k)` until kEnough seconds of processor time are used; queries per second.
template <class Batch>
double rate(std::size_t queries, std::size_t batches, const Batch& batch) {
  constexpr double kEnough = 0.02;
  double time = 0;
  std::size_t done = 0;
  while (done < batches && (done == 0 || time < kEnough)) {
    time += processor_seconds([&] { batch(done); });
    ++done;
  }
  return static_cast<double>(done * queries) / time;
}

// Random places, in batches. The first batch is asked once more before, since other work left the caches
// cold.
class Queries {
 public:
  explicit Queries(const Bounds& bounds)
      : x_(numbers_.many(kBatch * kBatches, bounds.low.x, bounds.high.x)),
        y_(numbers_.many(kBatch * kBatches, bounds.low.y, bounds.high.y)),
        z_(numbers_.many(kBatch * kBatches, bounds.low.z, bounds.high.z)) {}

  double points_per_second(const Representation& built) {
    return warm_rate([&](std::size_t b) {
      built.materials({part(x_, b), part(y_, b), part(z_, b)}, materials_);
    });
  }
  double columns_per_second(const Representation& built) {
    return warm_rate([&](std::size_t b) {
      sink_.clear();
      built.spans({part(x_, b), part(z_, b)}, sink_);
    });
  }

 private:
  static constexpr std::size_t kBatch = 1024, kBatches = 256;
  template <class Batch>
  static double warm_rate(const Batch& batch) {
    batch(0);
    return rate(kBatch, kBatches, batch);
  }
  static std::span<const float> part(const std::vector<float>& all, std::size_t batch) {
    return std::span(all).subspan(batch * kBatch, kBatch);
  }

  Numbers numbers_;
  std::vector<float> x_, y_, z_;
  std::vector<Material> materials_{kBatch};
  SpanSink sink_;
};

}  // namespace

std::unique_ptr<Representation> measure_build(const Scene& scene, const RepresentationType& type,
                                              const Parameters& parameters, Recorder& recorder,
                                              Samples& samples, Progress& progress) {
  const auto build = [&scene, &type, &progress, parameters] {
    return type.build(scene.source, parameters, progress);
  };
  std::unique_ptr<Representation> built = unless_refused(build);  // makes thread pools and tables
  const Memory memory = built->memory();
  recorder.add("payload", "B", memory.payload);
  recorder.add("index", "B", memory.index);
  recorder.add("slack", "B", memory.slack);
  recorder.add("bytes", "B", memory.total());
  recorder.add("heap_bytes", "B", static_cast<double>(destroy_and_count(std::move(built))));
  samples.add("build_time", "s", [build] { return seconds_to_make(build); });
  return build();
}

void measure_file(const Scene& scene, const RepresentationType& type, const Representation& built,
                  Recorder& recorder, Samples& samples) {
  const auto folder = std::make_shared<TemporaryFolder>();  // as long as the work that uses it
  const std::filesystem::path file = folder->path() / "scratch";
  const std::size_t bytes = save_representation(file, type, built);
  recorder.add("file_bytes", "B", bytes);
  recorder.add("file_of_heightmap", "",
               static_cast<double>(bytes) / static_cast<double>(scene.heightmap_bytes));
  const std::unique_ptr<Representation> copy = load_representation(file).representation;
  constexpr std::size_t kMost = 4096;
  const std::size_t n = std::min(kMost, scene.lines.x.size());
  const Columns at{std::span(scene.lines.x).first(n), std::span(scene.lines.z).first(n)};
  SpanSink own, loaded;
  built.spans(at, own);
  copy->spans(at, loaded);
  std::size_t differ = 0;
  for (std::size_t c = 0; c < n; ++c) differ += !std::ranges::equal(own.column(c), loaded.column(c));
  recorder.add("loaded_differs", "", differ);
  samples.time("save_time", [folder, file, &type, &built] { save_representation(file, type, built); });
  samples.add("load_time", "s", [folder, file] {
    return seconds_to_make([&] { return load_representation(file).representation; });
  });
}

void measure_queries(const Scene& scene, const Representation& built, Samples& samples) {
  const auto queries = std::make_shared<Queries>(scene.lines.bounds);
  samples.add("points_per_second", "1/s", [queries, &built] { return queries->points_per_second(built); });
  samples.add("columns_per_second", "1/s", [queries, &built] { return queries->columns_per_second(built); });
}

TriangleMesh measure_mesh(const Representation& built, Recorder& recorder, Samples& samples) {
  TriangleMesh mesh = built.mesh({});
  recorder.add("triangles", "", mesh.triangles());
  samples.add("mesh_time", "s", [&built] { return seconds_to_make([&] { return built.mesh({}); }); });
  return mesh;
}

}  // namespace terrabench::cross
