#include "representations/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "representations/export/fog_volume.h"
#include "representations/export/span_table.h"
#include "representations/procedural_mesh/mesh_files.h"
#include "terrain/error.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

using Path = std::filesystem::path;

bool every_type(const RepresentationType&) { return true; }
bool with_overhangs(const RepresentationType& type) { return type.traits.overhangs; }

void write_own_form(const Path& path, const RepresentationType& type, const Representation& built,
                    const LineGrid&, Progress&) {
  save_representation(path, type, built);
}

void write_raster(const Path& path, const RepresentationType&, const Representation& built,
                  const LineGrid& lines, Progress&) {
  Heightfield field = Heightfield::zeros(lines.width, lines.depth, static_cast<float>(lines.cell_x),
                                         static_cast<float>(lines.cell_z));
  field.georeference = lines.georeference;
  topmost(built, lines, 0, field.heights);
  write_geotiff(path, field);
}

void write_polygons(const Path& path, const RepresentationType&, const Representation& built, const LineGrid&,
                    Progress&) {
  const FaceMesh mesh = built.polygons();
  if (mesh.faces() == 0) {
    throw usage_error("there are no faces to write", path.string(), "write it under another extension");
  }
  write_mesh(path, mesh);
}

void write_table(const Path& path, const RepresentationType&, const Representation& built,
                 const LineGrid& lines, Progress& progress) {
  write_spans(path, built, lines, progress);
}

void write_volume(const Path& path, const RepresentationType&, const Representation& built,
                  const LineGrid& lines, Progress& progress) {
  write_fog(path, built, lines, progress);
}

std::string extension_of(const Path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ".tiff" ? ".tif" : extension;
}

}  // namespace

std::span<const ExportFormat> export_formats() {
  static const ExportFormat kFormats[] = {
      {".tb", "the structure's own form", every_type, write_own_form},
      {".tif", "GeoTIFF of the topmost surface", every_type, write_raster},
      {".ply", "polygons", every_type, write_polygons},
      {".obj", "polygons", every_type, write_polygons},
      {".csv", "table of spans", every_type, write_table},
      {".vdb", "OpenVDB fog volume", with_overhangs, write_volume},
  };
  return kFormats;
}

const ExportFormat& export_format(const Path& path, const RepresentationType& type) {
  const std::string extension = extension_of(path);
  std::vector<std::string_view> writable;
  for (const ExportFormat& format : export_formats()) {
    if (!format.can_write(type)) continue;
    if (format.extension == extension) return format;
    writable.push_back(format.extension);
  }
  throw usage_error(extension.empty() ? "the name has no extension"
                                      : fmt::format("'{}' cannot be written as {}", type.name, extension),
                    path.string(), fmt::format("it can be written as {}", alternatives(writable)));
}

Exported export_representation(const Path& path, const RepresentationType& type, const Representation& built,
                               const LineGrid& lines, Progress& progress) {
  const ExportFormat& format = export_format(path, type);
  format.write(path, type, built, lines, progress);
  std::error_code ignored;
  return {format.summary, std::filesystem::file_size(path, ignored)};
}

}  // namespace terrabench
