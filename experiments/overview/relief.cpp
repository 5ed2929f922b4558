// Every terrain in every representation: build time, bytes, fidelity and a picture.
#include <fmt/format.h>

#include <array>

#include "experiments/fidelity.h"
#include "experiments/figures/sheet.h"
#include "experiments/ground.h"
#include "experiments/refusals.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "renderers/scene.h"
#include "representations/representation.h"
#include "results/store/format.h"
#include "terrain/files.h"
#include "terrain/view.h"

namespace terrabench::relief {
namespace {

const std::array kSpecs{
    ParameterSpec{"representation", std::string("heightmap"), "",
                  "a name of `terrabench list representations`"},
    ParameterSpec{"width", std::int64_t{1600}, "pixels", "width of the picture", 1, 16384},
    ParameterSpec{"height", std::int64_t{1000}, "pixels", "height of the picture", 1, 16384},
};

// Part of a file name: the catalogue name; for a path its stem and a digest, since two folders may hold files
// of one name.
std::string file_name(const std::string& terrain) {
  const std::string file = terrain_file(terrain);
  if (file.empty()) return terrain;
  std::string name = std::filesystem::path(file).stem().string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return fmt::format("{}-{}", name, checksum(terrain).substr(0, 8));
}

std::vector<Case> cases(const RunOptions& options) {
  std::vector<Case> cases;
  for (const std::string& terrain : grounds(options, {"jacksboro", "caves"})) {
    for (const RepresentationType& type : representations()) {
      cases.push_back({fmt::format("{}/{}", terrain, type.name),
                       {kSpecs, {{"representation", std::string(type.name)}}},
                       terrain});
    }
  }
  return cases;
}

void record(const Fidelity& fidelity, Recorder& recorder) {
  if (!fidelity.from_heights) {
    if (!fidelity.compared) {
      return recorder.undefined({"volume_iou"}, "no sample is solid in the representation or the ground");
    }
    return recorder.add("volume_iou", "", fidelity.volume_iou);
  }
  recorder.add("lost_columns", "", fidelity.lost);
  if (!fidelity.compared) {
    return recorder.undefined({"rmse", "largest_error"}, "the representation and the ground share no column");
  }
  recorder.add("rmse", "m", fidelity.rmse);
  recorder.add("largest_error", "m", fidelity.largest_error);
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = recorder.terrain(open_terrain(test_case.terrain, options.seed));
  const RepresentationType& type = representation(test_case.parameters.text("representation"));
  std::unique_ptr<Representation> built;
  for (int i = 0; i < kSamples; ++i) {
    built.reset();
    const Stopwatch watch;
    built = unless_refused([&] { return type.build(source, Parameters(type.parameters), progress); });
    recorder.add("build_time", "s", watch.seconds());
  }
  recorder.add("bytes", "B", built->memory().total());
  record(measure_fidelity(*built, source, progress), recorder);

  const TriangleMesh mesh = built->mesh({});
  if (mesh.triangles() == 0) throw SkippedCase("the representation holds no ground to draw");
  recorder.add("triangles", "", mesh.triangles());
  const View view = overview(bounds_of(mesh), test_case.integer("width"), test_case.integer("height"));
  const auto context = open_context(options.renderer, view.width, view.height);
  const Bounds ground = source.bounds();  // the same colours for every representation of it
  const Image image = render_relief(*context, mesh, view, {.lowest = ground.low.y, .highest = ground.high.y});
  const std::string id = fmt::format("relief.{}.{}", file_name(test_case.terrain), type.name);
  write_picture(
      recorder
          .figure(id,
                  fmt::format(
                      "{} as {}: {} triangles, from {:.0f} m (dark) to {:.0f} m (light), sun from the "
                      "north-west, view from the south",
                      source.name, type.label, format_count(mesh.triangles()), ground.low.y, ground.high.y))
          .path,
      image);
}

}  // namespace

extern const Experiment kRelief{
    "overview.relief", "Shaded relief of each terrain in each representation", kSpecs, cases, measure,
    Experiment::kTimed};

}  // namespace terrabench::relief
