#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <cassert>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/geotiff_rows.h"

namespace terrabench {
namespace {

void describe(GDALDataset& dataset, const Heightfield& field, const std::string& unit) {
  std::array<double, 6> transform = field.georeference.transform;
  // Without a georeference the file still holds the size of the cells.
  if (transform == std::array<double, 6>{}) transform = {0, field.cell_x, 0, 0, 0, -field.cell_z};
  dataset.SetGeoTransform(transform.data());
  if (!field.georeference.crs.empty()) {
    OGRSpatialReference reference;
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (reference.importFromWkt(field.georeference.crs.c_str()) == OGRERR_NONE)
      dataset.SetSpatialRef(&reference);
  }
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  // NaN in the file too: any number could be a height.
  band.SetNoDataValue(Heightfield::kNoData);
  band.SetUnitType(unit.c_str());
}

}  // namespace

void write_geotiff(const std::filesystem::path& path, const Heightfield& field, const std::string& unit) {
  register_gdal();
  NewFile file(path);  // before the dataset, so that it is destroyed after the dataset is closed
  const GdalMessages messages;
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  DatasetPointer dataset(
      driver->Create(file.temporary().c_str(), field.width, field.depth, 1, GDT_Float32, options));
  if (dataset == nullptr) throw cannot_write(path, messages.first_failure());
  describe(*dataset, field, unit);
  // One signature for reading and writing: writing does not change the heights.
  const CPLErr error = dataset->GetRasterBand(1)->RasterIO(
      GF_Write, 0, 0, field.width, field.depth, const_cast<float*>(field.heights.data()), field.width,
      field.depth, GDT_Float32, 0, 0, nullptr);
  if (error != CE_None || messages.failed()) throw cannot_write(path, messages.first_failure());
  // A full disk may be reported only when the last blocks and the directory are written.
  dataset.reset();
  if (messages.failed()) throw cannot_write(path, messages.first_failure());
  file.keep();
}

struct GeotiffRows::File {
  std::filesystem::path path;
  GdalMessages messages;  // before the dataset: collects what closing reports
  DatasetPointer dataset;
  int written = 0;  // rows

  Error refused() const { return cannot_write(path, messages.first_failure()); }
};

GeotiffRows::GeotiffRows(const std::filesystem::path& path, int width, int depth, float cell_x,
                         float cell_z) {
  register_gdal();
  file_ = std::make_unique<File>();
  file_->path = path;
  CPLStringList options;
  const std::string tile = fmt::format("{}", kGeotiffTile);
  options.SetNameValue("TILED", "YES");
  options.SetNameValue("BLOCKXSIZE", tile.c_str());
  options.SetNameValue("BLOCKYSIZE", tile.c_str());
  options.SetNameValue("COMPRESS", "ZSTD");
  options.SetNameValue("ZSTD_LEVEL", "3");
  options.SetNameValue("PREDICTOR", "3");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  options.SetNameValue("NUM_THREADS", "ALL_CPUS");
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  file_->dataset.reset(driver->Create(path.c_str(), width, depth, 1, GDT_Float32, options));
  if (file_->dataset == nullptr) throw file_->refused();
  double transform[] = {0, cell_x, 0, 0, 0, -cell_z};
  file_->dataset->SetGeoTransform(transform);
}

GeotiffRows::~GeotiffRows() = default;

void GeotiffRows::write(std::span<const float> heights) {
  const int width = file_->dataset->GetRasterXSize();
  const int rows = static_cast<int>(heights.size() / width);
  assert(heights.size() % width == 0 && file_->written + rows <= file_->dataset->GetRasterYSize());
  // One signature for reading and writing: writing does not change the buffer.
  const CPLErr error = file_->dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, file_->written, width, rows,
                                                                  const_cast<float*>(heights.data()), width,
                                                                  rows, GDT_Float32, 0, 0, nullptr);
  if (error != CE_None || file_->messages.failed()) throw file_->refused();
  file_->written += rows;
}

// A full disk may be reported only here.
void GeotiffRows::close() {
  file_->dataset.reset();
  if (file_->messages.failed()) throw file_->refused();
}

}  // namespace terrabench
