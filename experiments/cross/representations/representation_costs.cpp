#include "experiments/cross/representations/representation_costs.h"

#include <algorithm>
#include <memory>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/cross/workloads.h"
#include "experiments/stopwatch.h"

namespace terrabench::cross {
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
  recorder.add("file_bytes", "B", static_cast<double>(save_representation(file, type, built)));
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
  samples.add("load_time", "s", [folder, file] {
    return seconds_to_make([&] { return load_representation(file).representation; });
  });
}

void measure_queries(const Scene& scene, const Representation& built, Samples& samples) {
  const auto numbers = std::make_shared<Numbers>(1);
  const auto places = [numbers, &scene] { return Places(scene.lines.bounds, 1, *numbers); };
  samples.add("points_per_second", "1/s",
              [places, &built] { return 1 / seconds_per_point(built, places()); });
  samples.add("columns_per_second", "1/s",
              [places, &built] { return 1 / seconds_per_column(built, places()); });
}

TriangleMesh measure_mesh(const Representation& built, Recorder& recorder, Samples& samples) {
  TriangleMesh mesh = built.mesh({});
  recorder.add("triangles", "", mesh.triangles());
  samples.add("mesh_time", "s", [&built] { return seconds_to_make([&] { return built.mesh({}); }); });
  return mesh;
}

}  // namespace terrabench::cross
