#include "experiments/cross/files/read_back.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "representations/export/fog_volume.h"
#include "representations/export/span_table.h"
#include "representations/procedural_mesh/mesh_files.h"
#include "representations/procedural_mesh/triangle_columns.h"
#include "terrain/error.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench::cross {
namespace {

Heightfield empty_field(const LineGrid& lines) {
  Heightfield field = Heightfield::zeros(lines.width, lines.depth, static_cast<float>(lines.cell_x),
                                         static_cast<float>(lines.cell_z));
  std::ranges::fill(field.heights, Heightfield::kNoData);
  return field;
}

Heightfield from_own_form(const std::filesystem::path& path, const LineGrid& lines) {
  Heightfield field = empty_field(lines);
  topmost(*load_representation(path).representation, lines, 0, field.heights);
  return field;
}

Heightfield from_raster(const std::filesystem::path& path, const LineGrid&) { return read_dem(path).heights; }

Heightfield from_table(const std::filesystem::path& path, const LineGrid& lines) {
  return heights_of(read_spans(path), lines);
}

Heightfield from_volume(const std::filesystem::path& path, const LineGrid&) { return read_fog_heights(path); }

// Polygons as fans.
std::vector<Triangle> triangles_of(const FaceMesh& mesh) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.corners.size());
  for (std::size_t face = 0; face < mesh.faces(); ++face) {
    const std::uint32_t first = mesh.first_corner[face], end = mesh.first_corner[face + 1];
    for (std::uint32_t c = first + 2; c < end; ++c) {
      triangles.push_back({mesh.corners[first], mesh.corners[c - 1], mesh.corners[c]});
    }
  }
  return triangles;
}

Heightfield from_polygons(const std::filesystem::path& path, const LineGrid& lines) {
  FaceMesh mesh = read_mesh(path);
  std::vector<Triangle> triangles = triangles_of(mesh);
  const TriangleColumns columns(std::move(mesh.positions), std::move(triangles));
  Heightfield field = empty_field(lines);
  tbb::parallel_for(0, lines.depth, [&](int j) {
    std::vector<Crossing> crossings;
    for (int i = 0; i < lines.width; ++i) {
      columns.crossings(lines.x(i), lines.z(j), crossings);
      if (!crossings.empty()) field.at(i, j) = crossings.back().y;
    }
  });
  return field;
}

struct Form {
  std::string_view extension;
  Heightfield (*read)(const std::filesystem::path&, const LineGrid&);
};
constexpr std::array kForms{Form{".tb", from_own_form},  Form{".tif", from_raster},
                            Form{".ply", from_polygons}, Form{".obj", from_polygons},
                            Form{".csv", from_table},    Form{".vdb", from_volume}};

}  // namespace

Heightfield read_back(const std::filesystem::path& path, const LineGrid& lines) {
  const auto form = std::ranges::find(kForms, path.extension().string(), &Form::extension);
  if (form == kForms.end()) {
    throw usage_error("nothing reads this form back", path.string(),
                      "add the form to experiments/cross/files/read_back.cpp");
  }
  return form->read(path, lines);
}

}  // namespace terrabench::cross
