#include "representations/export/export.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "experiments/commands/commands.h"
#include "results/store/format.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

// The samples of the DEM, which must cover the same ground to within a cell.
LineGrid lines_like(const std::string& dem, const Representation& built, Progress& progress) {
  const Heightfield field = read_dem(dem, {}, &progress).heights;
  const Bounds bounds = built.bounds();
  const auto differs = [](float low, float high, float extent, float cell) {
    return std::abs(low) > cell || std::abs(high - extent) > cell;
  };
  if (differs(bounds.low.x, bounds.high.x, field.extent_x(), field.cell_x) ||
      differs(bounds.low.z, bounds.high.z, field.extent_z(), field.cell_z)) {
    throw usage_error(fmt::format("covers {:.6g} m × {:.6g} m, but the representation {:.6g} m × {:.6g} m",
                                  field.extent_x(), field.extent_z(), bounds.size().x, bounds.size().z),
                      dem, "name the DEM that it was built from, cropped alike");
  }
  return lines_of(field);
}

}  // namespace

void print_export(const std::filesystem::path& path, const RepresentationType& type,
                  const Representation& built, const LineGrid& lines, Progress& progress) {
  const Exported file = export_representation(path, type, built, lines, progress);
  fmt::print("saved       {} ({}, {})\n", path.string(), file.summary,
             format_quantity(static_cast<double>(file.bytes), "B"));
}

ExitCode export_command(const ExportArguments& a) {
  Progress progress(isatty(STDERR_FILENO) != 0 ? Progress::Output::kTerminal : Progress::Output::kLines);
  const Loaded loaded = load_representation(a.saved);
  export_format(a.out, *loaded.type);  // before the DEM is read
  const LineGrid lines = a.like.empty() ? own_lines(*loaded.representation)
                                        : lines_like(a.like, *loaded.representation, progress);
  print_export(a.out, *loaded.type, *loaded.representation, lines, progress);
  if (a.like.empty() && a.out.extension() == ".tif") {
    fmt::print("note        without place and reference system; those of the DEM: --like FILE\n");
  }
  return ExitCode::kGood;
}

}  // namespace terrabench
