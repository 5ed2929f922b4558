#include <cpl_string.h>
#include <ogr_spatialref.h>

#include <algorithm>

#include "terrain/new_file.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"

namespace terrabench {
namespace {

void describe(GDALDataset& dataset, const HeightRows& raster, const std::string& unit) {
  const Georeference& georeference = raster.georeference;
  if (georeference.transform != std::array<double, 6>{}) {
    std::array<double, 6> transform = georeference.transform;
    dataset.SetGeoTransform(transform.data());
  } else {
    // Without a georeference the file still holds the size of the cells.
    std::array<double, 6> transform{0, raster.cell_x, 0, 0, 0, -raster.cell_z};
    dataset.SetGeoTransform(transform.data());
  }
  if (!georeference.crs.empty()) {
    OGRSpatialReference reference;
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (reference.importFromWkt(georeference.crs.c_str()) == OGRERR_NONE) dataset.SetSpatialRef(&reference);
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  // NaN in the file too: any number could be a height.
  band.SetNoDataValue(Heightfield::kNoData);
  band.SetUnitType(unit.c_str());
}

void write_rows(GDALRasterBand& band, const HeightRows& raster, const GdalMessages& messages,
                const std::filesystem::path& path, Progress* progress) {
  constexpr int kRows = 64;
  std::vector<float> heights;
  if (progress != nullptr)
    progress->begin("writing " + path.string(), static_cast<std::uint64_t>(raster.depth));
  for (int y = 0; y < raster.depth; y += kRows) {
    const int rows = std::min(kRows, raster.depth - y);
    heights.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(raster.width));
    raster.fill(y, heights);
    const CPLErr error = band.RasterIO(GF_Write, 0, y, raster.width, rows, heights.data(), raster.width, rows,
                                       GDT_Float32, 0, 0, nullptr);
    if (error != CE_None || messages.failed()) throw cannot_write(path, messages.first_failure());
    if (progress != nullptr) progress->advance(static_cast<std::uint64_t>(rows));
  }
  if (progress != nullptr) progress->end();
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const HeightRows& raster, const std::string& unit,
                   Progress* progress) {
  register_gdal();
  NewFile file(path);  // before the dataset, so that it is destroyed after the dataset is closed
  const GdalMessages messages;
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  DatasetPointer dataset(
      driver->Create(file.temporary().c_str(), raster.width, raster.depth, 1, GDT_Float32, options));
  if (dataset == nullptr) throw cannot_write(path, messages.first_failure());
  describe(*dataset, raster, unit);
  write_rows(*dataset->GetRasterBand(1), raster, messages, path, progress);
  // A full disk may be reported only when the last blocks and the directory are written.
  dataset.reset();
  if (messages.failed()) throw cannot_write(path, messages.first_failure());
  file.keep();
}

void write_geotiff(const std::filesystem::path& path, const Heightfield& field, const std::string& unit) {
  const auto fill = [&](int first, std::span<float> out) {
    const auto from = static_cast<std::size_t>(first) * static_cast<std::size_t>(field.width);
    std::copy_n(field.heights.begin() + static_cast<std::ptrdiff_t>(from), out.size(), out.begin());
  };
  write_geotiff(path, {field.width, field.depth, field.cell_x, field.cell_z, field.georeference, fill}, unit);
}

}  // namespace terrabench
