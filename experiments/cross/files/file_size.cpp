// File size against error: every type with its coder, its settings chosen by the same search, beside formats
// that GDAL writes.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "experiments/cross/files/file_search.h"
#include "experiments/experiment.h"
#include "representations/coding/height_codec.h"
#include "terrain/heightfield.h"
#include "terrain/sources/dem/compressed_sizes.h"

namespace terrabench::cross {
namespace {

constexpr std::string_view kFormats = "formats";

const std::array kSpecs{
    ParameterSpec{"representation", std::string("heightmap"), "",
                  "a name of `terrabench list representations`; formats: those that GDAL writes, of heights"},
    ParameterSpec{"builds", std::int64_t{320}, "", "of each type, to search its settings", 1, 100000},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground, at most", 2, 4096},
    ParameterSpec{"lines", std::int64_t{101}, "", "along solid ground, on which volumes are compared", 2,
                  4001},
};

// Percent of the relief for the largest error of heights; percent of the volume that differs for solids. The
// first is ranked.
constexpr std::array kHeightErrors{1.0, 0.1, 3.0, 0.3, 10.0, 0.03};
constexpr std::array kSolidErrors{3.0, 1.0, 10.0};
constexpr double kRmse = 0.5;                  // percent of the relief at which RMSEs are compared
constexpr std::array kShares{1.0, 5.0, 20.0};  // percent of the ground's own bytes

struct Format {
  RasterCodec codec;
  std::string_view name;
};
constexpr std::array kGdalFormats{
    Format{RasterCodec::kJpeg2000, "jpeg2000"}, Format{RasterCodec::kLercDeflate, "lerc_deflate"},
    Format{RasterCodec::kPng, "png"}, Format{RasterCodec::kZstdDifferences, "differences_zstd"}};

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain : compared_scenes(options)) {
    const auto add = [&](std::string_view representation) {
      cases.push_back({fmt::format("{}/{}", terrain, representation),
                       {kSpecs,
                        {{"representation", std::string(representation)},
                         {"builds", std::int64_t{paper ? 320 : 40}},
                         {"size", std::int64_t{paper ? 513 : 257}},
                         {"resolution", std::int64_t{64}},
                         {"lines", std::int64_t{paper ? 211 : 101}}}},
                       terrain});
    };
    for (const RepresentationType& type : representations()) add(type.name);
    add(kFormats);
  }
  return cases;
}

void record_smallest(const std::vector<BuiltFile>& files, FileError error, double percent, double unit,
                     Recorder& recorder) {
  const std::string bytes = fmt::format("bytes_within_{:g}%", percent);
  if (const BuiltFile* file = smallest_within(files, error, percent / 100 * unit)) {
    recorder.add(bytes, "B", static_cast<double>(file->bytes));
  } else {
    recorder.undefined({bytes}, "no file that the search made is so close to the ground");
  }
}

void record_closest(const std::vector<BuiltFile>& files, FileError error, std::string_view metric,
                    std::string_view unit, double own, Recorder& recorder) {
  for (const double percent : kShares) {
    const std::string name = fmt::format("{}_at_{:g}%", metric, percent);
    if (const BuiltFile* file = closest_within(files, error, percent / 100 * own)) {
      recorder.add(name, unit, file->*error);
    } else {
      recorder.undefined({name}, "no file that the search made is so small");
    }
  }
}

struct Jpeg2000 {
  SceneOptions of;
  CompressedSize same_largest, same_rmse;
};

// Kept for the ground that was asked for last: it takes some thirty compressions.
const Jpeg2000& jpeg2000(const Scene& scene) {
  static std::optional<Jpeg2000> kept;
  if (kept && kept->of == scene.options) return *kept;
  const double relief = relief_of(scene);
  const auto at = [&](double percent, double CompressedSize::*error) {
    return compressed_size_at(*scene.source.heights, RasterCodec::kJpeg2000, percent / 100 * relief, error);
  };
  return kept.emplace(Jpeg2000{scene.options, at(kHeightErrors.front(), &CompressedSize::largest),
                               at(kRmse, &CompressedSize::rmse)});
}

// How many times the bytes of JPEG 2000 at the same error the smallest file of the type takes.
void record_beside_jpeg2000(const std::vector<BuiltFile>& files, const Scene& scene, Recorder& recorder) {
  const auto add = [&](const char* metric, FileError error, double percent, std::size_t peer_bytes,
                       double peer_error) {
    const double most = percent / 100 * relief_of(scene);
    const BuiltFile* const file = smallest_within(files, error, most);
    if (file == nullptr)
      return recorder.undefined({metric}, "no file that the search made is so close to the ground");
    if (peer_error > most) return recorder.undefined({metric}, "JPEG 2000 does not come so close");
    recorder.add(metric, "", static_cast<double>(file->bytes) / static_cast<double>(peer_bytes));
  };
  const auto& [of, largest, rmse] = jpeg2000(scene);
  add("beside_jpeg2000", &BuiltFile::largest, kHeightErrors.front(), largest.bytes, largest.largest);
  add("beside_jpeg2000_rmse", &BuiltFile::rmse, kRmse, rmse.bytes, rmse.rmse);
}

// Every error and size at which files are compared.
std::vector<FileAim> aims_of(const Scene& scene) {
  const bool heights = scene.source.heights.has_value();
  const double relief = relief_of(scene), own = own_bytes(scene);
  std::vector<FileAim> aims;
  if (heights) {
    for (const double percent : kHeightErrors)
      aims.push_back({FileAim::kError, &BuiltFile::largest, percent / 100 * relief});
    aims.push_back({FileAim::kError, &BuiltFile::rmse, kRmse / 100 * relief});
  } else {
    for (const double percent : kSolidErrors)
      aims.push_back({FileAim::kError, &BuiltFile::volume_error, percent / 100});
  }
  for (const double percent : kShares)
    aims.push_back(
        {FileAim::kBytes, heights ? &BuiltFile::rmse : &BuiltFile::volume_error, percent / 100 * own});
  return aims;
}

void measure_type(const Scene& scene, const RepresentationType& type, int builds, Recorder& recorder,
                  Progress& progress) {
  const bool heights = scene.source.heights.has_value();
  const FileError error = heights ? &BuiltFile::largest : &BuiltFile::volume_error;
  const std::span<const double> percents = heights ? std::span<const double>(kHeightErrors) : kSolidErrors;
  const double unit = heights ? relief_of(scene) : 1, own = own_bytes(scene);
  const std::vector<BuiltFile> files = search_files(scene, type, builds, aims_of(scene), progress);
  if (files.empty()) throw SkippedCase("the type cannot hold this ground at any setting that was tried");
  const std::vector<BuiltFile> best = best_files(files, error);
  recorder.add("best_files", "", static_cast<double>(best.size()));
  for (const BuiltFile& file : best) {
    recorder.add("best_bytes", "B", static_cast<double>(file.bytes));
    recorder.add("best_error", heights ? "m" : "", file.*error);
  }
  for (const double percent : percents) record_smallest(files, error, percent, unit, recorder);
  // Of the error by which files are ranked.
  if (const BuiltFile* file = smallest_within(files, error, percents.front() / 100 * unit))
    recorder.add(fmt::format("share_within_{:g}%", percents.front()), "",
                 static_cast<double>(file->bytes) / own);
  if (!heights) return record_closest(files, error, "volume_error", "", own, recorder);
  record_closest(files, &BuiltFile::rmse, "rmse", "m", own, recorder);
  for (const BuiltFile& file : best_files(files, &BuiltFile::rmse)) {
    recorder.add("best_rmse_bytes", "B", static_cast<double>(file.bytes));
    recorder.add("best_rmse", "m", file.rmse);
  }
  record_beside_jpeg2000(files, scene, recorder);
}

void measure_formats(const Scene& scene, Recorder& recorder) {
  if (!scene.source.heights) throw SkippedCase("these formats hold heights, and the ground is a solid");
  const Heightfield& field = *scene.source.heights;
  const double relief = relief_of(scene), own = own_bytes(scene);
  for (const auto& [codec, name] : kGdalFormats) {
    for (const double percent : kHeightErrors) {
      const double most = percent / 100 * relief;
      // Steps as those of our own coder: errors of whole metres are whole.
      const double step = step_for(field.heights, most);
      const bool steps = codec == RasterCodec::kPng || codec == RasterCodec::kZstdDifferences;
      const CompressedSize size =
          codec == RasterCodec::kJpeg2000
              ? compressed_size_at(field, codec, most, &CompressedSize::largest)
              : compressed_size(field, codec, steps ? step : std::max(most, step / 2));
      if (size.largest > most * 1.001) continue;
      recorder.add(fmt::format("{}_bytes", name), "B", static_cast<double>(size.bytes));
      recorder.add(fmt::format("{}_error", name), "m", size.largest);
      recorder.add(fmt::format("{}_rmse", name), "m", size.rmse);
      recorder.add(fmt::format("{}_within_{:g}%", name, percent), "B", static_cast<double>(size.bytes));
      if (percent == kHeightErrors.front()) {
        recorder.add(fmt::format("{}_share_within_{:g}%", name, percent), "",
                     static_cast<double>(size.bytes) / own);
      }
    }
  }
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Scene& ground =
      scene({at.terrain, at.integer("size"), at.integer("resolution"), at.integer("lines"), options.seed},
            progress);
  recorder.terrain(ground.source);
  if (relief_of(ground) == 0) throw SkippedCase("the ground is flat: an error has no share of its relief");
  const std::string& name = at.parameters.text("representation");
  if (name == kFormats) return measure_formats(ground, recorder);
  measure_type(ground, representation(name), at.integer("builds"), recorder, progress);
}

}  // namespace

extern const Experiment kFileSize{"cross.file-size", "File size against error", kSpecs, cases, measure};

}  // namespace terrabench::cross
