// Files for other programs: every representation written as what it is. The format follows from the name's
// extension, in upper or lower case.
//
//   .tb          every type        the structure's own form, which load_representation() reads
//   .tif, .tiff  every type        GeoTIFF of the topmost surface along the lines (terrain/sources/dem/dem.h)
//   .ply, .obj   every type        polygons (procedural_mesh/mesh_files.h)
//   .csv         every type        table of spans (span_table.h)
//   .vdb         with overhangs    fog volume (fog_volume.h)
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "representations/line_grid.h"

namespace terrabench {

struct ExportFormat {
  std::string_view extension;  // ".tif"
  std::string_view summary;
  bool (*can_write)(const RepresentationType&);
  void (*write)(const std::filesystem::path&, const RepresentationType&, const Representation&,
                const LineGrid&, Progress&);
};

// One line per extension: export.cpp.
std::span<const ExportFormat> export_formats();

// By the name's extension. Throws usage_error, with the extensions that the type can write, for any other.
const ExportFormat& export_format(const std::filesystem::path&, const RepresentationType&);

struct Exported {
  std::string_view summary;  // of the format
  std::uintmax_t bytes = 0;  // on disk
};
// Written whole or not at all. Rasters, tables and volumes hold some rows of lines or the cells at a surface
// at a time; polygons are held whole. Throws usage_error as export_format() and for polygons of a
// representation that has none, environment_error when the file cannot be written.
Exported export_representation(const std::filesystem::path&, const RepresentationType&, const Representation&,
                               const LineGrid&, Progress&);

}  // namespace terrabench
