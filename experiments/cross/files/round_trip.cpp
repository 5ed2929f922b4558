// From a DEM to a representation, from that to a file of every form that its type can write, and back to
// heights: what comes back, what the file costs, and whether it still says where on the Earth it lies.
#include <fmt/format.h>

#include <array>

#include "experiments/cross/files/read_back.h"
#include "experiments/cross/files/temporary_folder.h"
#include "experiments/experiment.h"
#include "experiments/ground.h"
#include "representations/export/export.h"
#include "terrain/metrics/elevation_error.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"representation", std::string("heightmap"), "",
                  "a name of `terrabench list representations`"},
    ParameterSpec{"form", std::string("tif"), "", "of the file: an extension that the type can write"},
    ParameterSpec{"size", std::int64_t{97}, "samples", "longest sides of the ground's first part to use", 2,
                  16384},
    ParameterSpec{"step", 4.0, "m", "between levels, for types that have levels and are not lossless", 0.001,
                  1000},
};

std::vector<Case> cases(const RunOptions& options) {
  const std::int64_t size = options.profile == Profile::kPaper ? 193 : 97;
  std::vector<Case> cases;
  for (const std::string& terrain : grounds(options, {"jacksboro"})) {
    for (const RepresentationType& type : representations()) {
      for (const ExportFormat& format : export_formats()) {
        if (!format.can_write(type)) continue;
        const std::string form(format.extension.substr(1));
        cases.push_back(
            {fmt::format("{}/{}/{}", terrain, type.name, form),
             {kSpecs, {{"representation", std::string(type.name)}, {"form", form}, {"size", size}}},
             terrain});
      }
    }
  }
  return cases;
}

TerrainSource open_part(const Case& at, const RunOptions& options) {
  const TerrainSource source = open_heights(at.terrain, options.seed);
  const Heightfield& field = *source.heights;
  return source_of(source.name, crop(field, 0, 0, std::min(field.width, at.integer("size")),
                                     std::min(field.depth, at.integer("size"))));
}

Parameters settings(const RepresentationType& type, double step) {
  Parameters parameters(type.parameters);
  if (!type.traits.lossless && parameters.has("step")) parameters.set("step", step);
  return parameters;
}

// The six numbers of the georeference and the reference system; none where the file states nothing.
void compare_places(const Georeference& truth, const Georeference& kept, Recorder& recorder) {
  int fields = 0, equal = 0;
  if (kept != Georeference{}) {
    for (std::size_t k = 0; k < truth.transform.size(); ++k) equal += truth.transform[k] == kept.transform[k];
    equal += same_reference_system(truth.crs, kept.crs);
    fields = static_cast<int>(truth.transform.size()) + 1;
  }
  recorder.add("place_fields", "", fields);
  recorder.add("place_equal", "", equal);
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TerrainSource source = open_part(at, options);
  recorder.terrain(source);
  const Heightfield& ground = *source.heights;
  const RepresentationType& type = representation(at.parameters.text("representation"));
  const auto built = type.build(source, settings(type, at.parameters.number("step")), progress);
  const LineGrid lines = lines_of(ground);
  Heightfield own = ground;
  topmost(*built, lines, 0, own.heights);

  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / ("ground." + at.parameters.text("form"));
  const Exported written = export_representation(file, type, *built, lines, progress);
  const Heightfield kept = read_back(file, lines);

  const ElevationError whole = elevation_error(ground, kept), of_file = elevation_error(own, kept);
  recorder.add("samples", "", whole.pixels);
  recorder.add("lost", "", whole.unmatched);
  recorder.add("largest_error", "m", whole.largest);
  recorder.add("rmse", "m", whole.rmse);
  recorder.add_ratio("rmse_of_range", whole.rmse, whole.range, "the ground is flat");
  recorder.add("file_largest_error", "m", of_file.largest);
  recorder.add("file_lost", "", of_file.unmatched);
  recorder.add("file_bytes", "B", static_cast<double>(written.bytes));
  recorder.add("bytes_per_sample", "B",
               static_cast<double>(written.bytes) / static_cast<double>(own.heights.size()));
  compare_places(ground.georeference, kept.georeference, recorder);
}

}  // namespace

extern const Experiment kRoundTrip{"cross.round-trip", "DEM to file and back through every representation",
                                   kSpecs, cases, measure};

}  // namespace terrabench::cross
