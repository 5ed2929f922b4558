#include "representations/export/export.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "experiments/commands/commands.h"
#include "representations/export/surface_mesh.h"
#include "representations/procedural_mesh/mesh_files.h"
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

void write_surface(const ExportArguments& a, const Representation& built) {
  FaceMesh mesh = built.polygons();
  const std::size_t whole = mesh.faces();
  if (a.surface_only) mesh = surface_only(mesh, built.bounds());
  if (a.up == "z") turn_z_up(mesh);
  write_mesh(a.out, mesh);
  fmt::print("saved       {} ({} of {} polygons, {} up)\n", a.out.string(), mesh.faces(), whole, a.up);
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
  const std::string_view extension = export_format(a.out, *loaded.type).extension;  // before the DEM is read
  if (a.surface_only || a.up == "z") {
    if (extension != ".ply" && extension != ".obj")
      throw usage_error("--surface-only and --up are for polygons", a.out.string(), "write .ply or .obj");
    if (!a.like.empty())
      throw usage_error("does not apply to --surface-only and --up", "--like", "leave it out");
    write_surface(a, *loaded.representation);
    return ExitCode::kGood;
  }
  const LineGrid lines = a.like.empty() ? own_lines(*loaded.representation)
                                        : lines_like(a.like, *loaded.representation, progress);
  print_export(a.out, *loaded.type, *loaded.representation, lines, progress);
  if (a.like.empty() && a.out.extension() == ".tif") {
    fmt::print("note        without place and reference system; those of the DEM: --like FILE\n");
  }
  return ExitCode::kGood;
}

}  // namespace terrabench
